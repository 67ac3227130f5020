// A report of the program, shown in the page.
import { element } from "./elements.js";

/** The report in a frame of its own styles. Its script and its policy stay behind; the page's policy holds. */
export function reportView(html) {
    const report = new DOMParser().parseFromString(html, "text/html");
    const styles = [...report.querySelectorAll("style")].map((style) => style.textContent);
    report.querySelectorAll("script, style, meta, link").forEach((node) => node.remove());
    const sheet = new CSSStyleSheet();
    // The root of a report is the frame here, and so is what surrounds its text.
    sheet.replaceSync(styles.join("\n").replaceAll(":root", ":host").replace(/(^|})\s*body\{/g, "$1\n.report{"));
    const host = element("div", { className: "shown" });
    const frame = host.attachShadow({ mode: "open" });
    frame.adoptedStyleSheets = [sheet];
    frame.append(element("div", { className: "report" }, ...[...report.body.childNodes].map((node) => document.adoptNode(node))));
    return host;
}
