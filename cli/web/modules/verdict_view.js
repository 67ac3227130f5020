// The verdict of a calibration and what was found.
import { element } from "./elements.js";
import { notes } from "./info_view.js";

const LEVELS = { good: "✓ Good", care: "! With care", bad: "✗ Not to be used" };

/** Verdict, findings and next steps of a calibration that states them, in place of what the report's frame says of them; null
 * otherwise. */
export function verdictView(calibration, report) {
    const verdict = calibration?.verdict;
    if (!verdict?.level) {
        return null;
    }
    const sentence = report?.shadowRoot.querySelector(".verdict .sentence")?.textContent ?? "";
    report?.shadowRoot.querySelectorAll(".verdict, .warnings, .next").forEach((node) => node.remove());
    const texts = (calibration.findings ?? []).map(({ text }) => text).filter(Boolean);
    const next = (verdict.next ?? []).map(({ text, command }) => element("li", {}, element("code", {}, command ?? ""), ` ${text ?? ""}`));
    return element(
        "div",
        { className: `verdict ${verdict.level}` },
        element("p", { className: "level" }, LEVELS[verdict.level] ?? verdict.level),
        sentence ? element("p", {}, sentence) : null,
        notes("Findings", texts),
        next.length > 0 ? element("ol", {}, next) : null,
    );
}
