// Next steps of a verdict, each with a button where the page can do it.
import { inCommand } from "./advice.js";
import { button, element } from "./elements.js";

/** A list of steps; null where there are none. */
export function stepList(steps, page) {
    const item = ({ text, command }) => {
        const [label, act] = (command && action(command, page)) ?? [];
        return element(
            "li",
            {},
            `${text} `,
            label ? button(label, act) : null,
            command ? element("div", { className: "soft" }, "In a terminal: ", element("code", {}, command)) : null,
        );
    };
    const list = element("ol", { className: "steps" }, steps.map(item));
    return steps.length > 0 ? element("div", {}, element("p", {}, "What to do next, the most useful first:"), list) : null;
}

/** The words of a step's button and what it does; null where the page does not do what the command does. */
function action(command, page) {
    switch (command.split(" ")[1]) {
        case "discover":
            return ["Discover", () => page.further.discover()];
        case "plan":
            return ["Show the plan", () => page.further.plan()];
        case "apply":
        case "evaluate":
            return ["Choose a recording", () => document.getElementById("choose-other").click()];
        case "calibrate":
            return option(command, page);
        default:
            return null;
    }
}

/** What the page does for a calibration with other files or options: recordings are dropped together, a place is a person's to give, what
 * else is read otherwise can be tried. */
function option(command, page) {
    if (command.includes(" FIRST SECOND ")) {
        return ["Choose both recordings", () => document.getElementById("choose-files").click()];
    }
    if (/ --(gravity|latitude|altitude) /.test(command)) {
        return ["Give the place", () => page.choose("--latitude …", true)];
    }
    const first = inCommand(command);
    return first ? [`Use ${first.line}`, () => page.choose(first.line, first.isOpen)] : null;
}
