// The verdict of a calibration and what was found.
import { element } from "./elements.js";
import { notes } from "./info_view.js";
import { stepList } from "./steps.js";

const LEVELS = { good: "✓ Good", care: "! With care", bad: "✗ Not to be used" };

/** Verdict, findings and next steps of a calibration that states them, in place of what the report's frame says of them; the steps
 * alone otherwise. */
export function verdictView(calibration, report, page) {
    const verdict = calibration?.verdict;
    const next = takenSteps(report) ?? verdict?.next ?? [];
    if (!verdict?.level) {
        return stepList(next, page);
    }
    const sentence = report?.shadowRoot.querySelector(".verdict .sentence")?.textContent ?? "";
    report?.shadowRoot.querySelectorAll(".verdict, .warnings").forEach((node) => node.remove());
    const texts = (calibration.findings ?? []).map(({ text }) => text).filter(Boolean);
    return element(
        "div",
        { className: `verdict ${verdict.level}` },
        element("p", { className: "level" }, LEVELS[verdict.level] ?? verdict.level),
        sentence ? element("p", {}, sentence) : null,
        notes("Findings", texts),
        stepList(next, page),
    );
}

/** The steps of a report, which says more of each than the calibration does, taken out of it; undefined where there is none. */
function takenSteps(report) {
    const step = (line) => {
        const command = line.querySelector("code");
        command?.remove();
        return { text: line.textContent.trim().replace(/:$/, ""), command: command?.textContent };
    };
    const section = report?.shadowRoot.querySelector(".next");
    section?.remove();
    return section ? [...section.querySelectorAll("li")].map(step) : undefined;
}
