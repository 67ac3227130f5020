// A report of the program, shown in the page.
import { element } from "./elements.js";

/** The page around it has margins already. */
const NARROW = new CSSStyleSheet();
NARROW.replaceSync(".report{padding:0;background:none}h1{font-size:1.15rem}.scroll{background:var(--edges)}.number{white-space:nowrap}");

/** A number, perhaps with a sign of comparison. */
const NUMBER = /^([<>≤≥±] ?)?[-−+]?[\d.]+(e[-−]?\d+)?$/;

const STYLE = /<style>([^<]*)<\/style>/g;

/** The report in two frames of its own styles: verdict, figures and next steps; everything else. Its script and its policy stay behind. */
export function reportViews(html) {
    const styles = [...html.matchAll(STYLE)].map(([, style]) => style);
    // Styles are taken out as text: the page's policy would refuse those of a parsed document.
    const report = new DOMParser().parseFromString(html.replaceAll(STYLE, ""), "text/html");
    report.querySelectorAll("script, style, meta, link").forEach((node) => node.remove());
    report.querySelectorAll("td").forEach((cell) => cell.classList.toggle("number", NUMBER.test(cell.textContent.trim())));
    const details = [...report.querySelectorAll("main > section:not(.verdict):not(.next)")];
    const sheet = new CSSStyleSheet();
    // The root of a report is the frame here, and so is what surrounds its text.
    sheet.replaceSync(styles.join("\n").replaceAll(":root", ":host").replace(/(^|})\s*body\{/g, "$1\n.report{"));
    const rest = framed(sheet, details);
    // The page has its main part already.
    report.querySelectorAll("main").forEach((main) => main.replaceWith(element("div", {}, [...main.childNodes])));
    return [framed(sheet, [...report.body.childNodes]), rest];
}

function framed(sheet, nodes) {
    const host = element("div", { className: "shown" });
    const frame = host.attachShadow({ mode: "open" });
    frame.adoptedStyleSheets = [sheet, NARROW];
    frame.append(element("div", { className: "report" }, nodes.map((node) => document.adoptNode(node))));
    return host;
}
