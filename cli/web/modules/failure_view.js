// Why a call did not give what was asked, and what to do.
import { offered } from "./advice.js";
import { parsed } from "./documents.js";
import { button, element } from "./elements.js";

/** What a run says that failed, or null. */
export function failureOf(result) {
    if (result.gone) {
        return { message: result.gone };
    }
    if (result.failure) {
        const isMemory = /memory|allocat/i.test(result.failure + result.error);
        const message = isMemory
            ? "The browser has not enough memory for this. Use a shorter recording, or the program on the command line."
            : "The program ended unexpectedly: the file is damaged, or this is a fault of ours. Please report it with the message below.";
        return { message, detail: `${result.error}\n${result.failure}`.trim() };
    }
    if (result.code === 0) {
        return null;
    }
    const said = parsed(result.output)?.error;
    return said ?? { message: result.error.replace(/^(.*\n)*stillpoint: /, "").trim() || `status ${result.code}` };
}

/** The failure with buttons for the options that it offers, which do it `again` with one of them. Where a report says why, the buttons
 * alone. */
export function failureView(failure, page, again, isReported = false) {
    const lines = offered(failure.message).filter(({ line }) => !page.choices.has(line));
    const choices = lines.map(({ line, what, isOpen }) => {
        const label = `${isOpen ? "Complete" : "Use"} ${line}${what ? `: ${what}` : ""}`;
        return button(label, () => page.choose(line, isOpen, again));
    });
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
