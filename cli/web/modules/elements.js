// Elements of the page. Everything given to them is text.

/** An element with properties, `aria-…` and `data-…` attributes, and children: elements or text. */
export function element(name, properties = {}, ...children) {
    const made = document.createElement(name);
    for (const [key, value] of Object.entries(properties)) {
        if (key.includes("-")) {
            made.setAttribute(key, value);
        } else {
            made[key] = value;
        }
    }
    const all = children.flat().filter((child) => child !== null && child !== undefined && child !== "");
    made.append(...all.flatMap((child) => (typeof child === "string" ? unbroken(child) : child)));
    return made;
}

/** A text whose options stay whole at the end of a line. */
function unbroken(text) {
    return text.split(/((?<![\w-])--?[a-z][a-z-]{0,24})/).map((part, k) => {
        const option = document.createElement("span");
        option.className = "option";
        option.textContent = part;
        return k % 2 === 1 ? option : part;
    });
}

/** A button. */
export function button(text, pressed, className = "") {
    const made = element("button", { type: "button", className }, text);
    made.addEventListener("click", pressed);
    return made;
}

/** A table with a line of headings; the first column is of names. */
export function table(headings, rows) {
    const cell = (name) => (text, k) => element(name, name === "th" ? { scope: "col" } : {}, String(text));
    const head = element("thead", {}, element("tr", {}, headings.map(cell("th"))));
    const body = element("tbody", {}, rows.map((row) => element("tr", {}, row.map(cell("td")))));
    // What is wider than the page can be moved with the arrow keys.
    return element("div", { className: "scroll", tabIndex: 0, role: "region", "aria-label": headings[0] }, element("table", {}, head, body));
}

/** A line to copy, with its button. */
export function copied(line) {
    const said = element("span", { className: "soft", "aria-live": "polite" });
    const copy = button("Copy", async () => {
        try {
            await navigator.clipboard.writeText(line);
            said.textContent = "Copied";
        } catch {
            getSelection().selectAllChildren(code);
            said.textContent = "Selected: copy it with Ctrl+C";
        }
    });
    const code = element("code", {}, line);
    return element("div", { className: "command" }, element("pre", { tabIndex: 0 }, code), element("p", {}, copy, " ", said));
}

/** A link that saves bytes under a name. */
export function saved(name, bytes, type = "application/octet-stream") {
    const href = URL.createObjectURL(new Blob([bytes], { type }));
    return element("a", { href, download: name.split("/").pop(), className: "button" }, `Save ${name.split("/").pop()}`);
}

/** Puts elements into another, in place of what was there. */
export function show(into, ...children) {
    into.replaceChildren(...children.filter(Boolean));
}

/** Brings a section's heading to the reader, also to one who does not see it. */
export function focus(section) {
    const heading = section.querySelector("h2");
    heading.tabIndex = -1;
    heading.focus({ preventScroll: true });
    section.scrollIntoView({ block: "start" });
}
