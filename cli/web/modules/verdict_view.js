// The verdict of a calibration and what was found.
import { element } from "./elements.js";
import { notes } from "./info_view.js";
import { stepList } from "./steps.js";

const LEVELS = { good: "✓ Good", care: "! With care", bad: "✗ Not to be used" };

/** Verdict, findings and next steps of a calibration that states them, in place of what the report's frame says of them; null
 * otherwise the steps alone. */
export function verdictView(calibration, report, page) {
    const verdict = calibration?.verdict;
    if (!verdict?.level) {
        return nextView(report, page);
    }
    const sentence = report?.shadowRoot.querySelector(".verdict .sentence")?.textContent ?? "";
    const next = steps(report) ?? verdict.next ?? [];
    report?.shadowRoot.querySelectorAll(".verdict, .warnings, .next").forEach((node) => node.remove());
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

/** What to do next where there is no calibration; null where the report does not say it. */
function nextView(report, page) {
    const next = steps(report) ?? [];
    report?.shadowRoot.querySelectorAll(".next").forEach((node) => node.remove());
    return stepList(next, page);
}

/** The steps of a report, which says more of each than the calibration does; undefined where there is none. */
function steps(report) {
    const step = (line) => {
        const command = line.querySelector("code");
        command?.remove();
        return { text: line.textContent.trim().replace(/:$/, ""), command: command?.textContent };
    };
    const lines = report && [...report.shadowRoot.querySelectorAll(".next li")];
    return lines?.map(step);
}
