// Why a call did not give what was asked, and what to do.
import { offered } from "./advice.js";
import { button, element } from "./elements.js";

/** What a run says that failed, or null. */
export function failureOf(result) {
    if (result.failure) {
        const isMemory = /memory|allocat/i.test(result.failure + result.error);
        const message = isMemory
            ? "The browser has not enough memory for this. Use a shorter recording, or the program on the command line."
            : "The program ended unexpectedly: the file is damaged, or this is a fault of ours. Please report it with the message below.";
        return { message, detail: `${result.error}\n${result.failure}`.trim(), next: "" };
    }
    if (result.code === 0) {
        return null;
    }
    const said = parsed(result.output)?.error;
    return said ?? { message: result.error.replace(/^(.*\n)*stillpoint: /, "").trim() || `status ${result.code}`, next: "" };
}

/** The failure with buttons for the options that it offers; `choose` is given one of them. Where a report says why, the buttons alone. */
export function failureView(failure, choose, isReported = false) {
    const lines = offered(`${failure.message}\n${failure.next ?? ""}`);
    const choices = lines.map(({ line, isOpen }) => button(`${isOpen ? "Complete" : "Use"} ${line}`, () => choose(line, isOpen)));
    const offers = choices.length > 0 ? element("p", { className: "choices" }, choices) : null;
    if (isReported) {
        return offers;
    }
    return element(
        "div",
        { className: "failure", role: "alert" },
        element("p", {}, failure.message),
        offers,
        failure.detail ? element("pre", {}, failure.detail) : null,
    );
}

/** A document, or undefined where the text is none. */
export function parsed(text) {
    try {
        return JSON.parse(text);
    } catch {
        return undefined;
    }
}
