// Calibrations that are kept in the browser, where a person has asked for it.
import { button, element } from "./elements.js";
import { isCalibration, parsed } from "./documents.js";

const BEFORE = "stillpoint/";

/** The list of what is kept. */
export class Kept {
    constructor(section, chosen) {
        this.section = section;
        this.chosen = chosen;
        this.show();
    }

    keep(name, bytes) {
        try {
            localStorage.setItem(BEFORE + new Date().toISOString().slice(0, 19) + " " + name, new TextDecoder().decode(bytes));
        } catch (error) {
            this.section.append(element("p", { role: "alert" }, `The browser keeps nothing: ${error.message}`));
            return;
        }
        this.show();
    }

    show() {
        const keys = storedKeys();
        this.section.hidden = keys.length === 0;
        const rows = keys.map((key) => {
            const label = key.slice(BEFORE.length);
            const use = button(`Use ${label.replace("T", " ")}`, () => {
                this.chosen(label.slice(20), new TextEncoder().encode(localStorage.getItem(key)));
            });
            const forget = button("Forget", () => {
                localStorage.removeItem(key);
                this.show();
            });
            forget.setAttribute("aria-label", `Forget ${label}`);
            return element("li", {}, use, forget);
        });
        this.section.replaceChildren(element("h2", {}, "Kept in this browser"), element("ul", { className: "plain" }, rows));
    }
}

function storedKeys() {
    try {
        const isOurs = (key) => key.startsWith(BEFORE) && isCalibration(parsed(localStorage.getItem(key))?.schema);
        return Object.keys(localStorage).filter(isOurs).sort();
    } catch {
        // A browser may refuse a page from the disk its storage.
        return [];
    }
}
