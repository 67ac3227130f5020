// What can be done with a calibration: look for what it lacks, export it, correct or judge another recording with it, keep it.
import { chosen, recordings } from "./dropped.js";
import { copied, element, focus, saved, show } from "./elements.js";
import { failureOf, failureView, parsed } from "./failure_view.js";
import { Kept } from "./kept.js";
import { reportViews } from "./report_view.js";
import { commandLine } from "./shell_words.js";

/** Tools, what is written for each, and its name. */
const TARGETS = [
    ["px4", "PX4", "imu.params"],
    ["ardupilot", "ArduPilot", "imu.param"],
    ["ros", "ROS imu_calib", "imu_calib.yaml"],
    ["ros2", "ROS 2 parameters", "imu_ros2.yaml"],
    ["kalibr", "Kalibr", "imu.yaml"],
    ["imu_tk", "imu_tk", "imu_tk"],
    ["c", "C header", "imu.h"],
    ["rust", "Rust module", "imu.rs"],
    ["numpy", "NumPy module", "imu.py"],
    ["npz", "NumPy archive", "imu.npz"],
    ["matlab", "MATLAB script", "imu.m"],
    ["toml", "TOML", "cal.toml"],
];

const $ = (id) => document.getElementById(id);

/** The section below a calibration. */
export class Further {
    constructor(page) {
        this.page = page;
        this.calibration = undefined;
        this.kept = new Kept($("kept"), (name, bytes) => this.offer(name, bytes));
        $("target").append(...TARGETS.map(([value, name]) => element("option", { value }, name)));
        $("discover").addEventListener("click", () => this.discover());
        $("export").addEventListener("click", () => this.export());
        $("choose-other").addEventListener("click", () => $("other").click());
        $("other").addEventListener("change", () => {
            this.other = chosen($("other").files);
            $("other").value = "";
            this.showOther();
        });
        $("correct").addEventListener("click", () => this.correct());
        $("evaluate").addEventListener("click", () => this.evaluate());
        $("keep").addEventListener("click", () => this.kept.keep(...this.calibration));
        this.showOther();
    }

    hide() {
        $("further").hidden = true;
        show($("discovered"));
        show($("done"));
    }

    /** Offers what can be done with a calibration; discovery needs its recording too. */
    offer(name, bytes) {
        this.calibration = [name, bytes];
        $("further").hidden = false;
        // What must not be used is neither exported nor corrected with.
        const isBad = parsed(new TextDecoder().decode(bytes))?.verdict?.level === "bad";
        $("further").classList.toggle("refused", isBad);
        $("discovery").hidden = !this.page.results;
        $("of").textContent = name;
    }

    /** A calibration that was dropped. */
    async takeCalibration(files) {
        const [path, file] = files[0];
        this.page.files = [];
        this.offer(path, new Uint8Array(await file.arrayBuffer()));
        $("discovery").hidden = true;
    }

    async discover() {
        const { page } = this;
        await page.guarded(async () => {
            const options = page.choices.words();
            const words = ["discover", ...recordings(page.files), ...options, "-o", "findings.json", "--report", "findings.html"];
            const result = await page.busy.run("Discovering", [...words, "--json"], page.files);
            const made = new Map(result.files);
            const failure = failureOf(result);
            const report = made.get("findings.html");
            show(
                $("discovered"),
                element("h2", {}, "Discovery"),
                copied(commandLine(words)),
                failure ? failureView(failure, (line, isOpen) => page.choose(line, isOpen)) : null,
                element("p", { className: "choices" }, [...made].map(([name, bytes]) => saved(name, bytes))),
                ...(report ? reportViews(new TextDecoder().decode(report)) : []),
            );
            focus($("discovered"));
            const findings = made.get("findings.json");
            if (findings) {
                this.offer("findings.json", findings);
            }
        });
    }

    /** What to record next. */
    async plan() {
        await this.finish("Planning", ["plan", this.calibration[0]], []);
    }

    async export() {
        const [target, , file] = TARGETS.find(([value]) => value === $("target").value);
        const [name] = this.calibration;
        await this.finish("Exporting", ["export", name, "--to", target, "-o", file], []);
    }

    async correct() {
        const [name] = this.calibration;
        const words = ["apply", name, ...recordings(this.other), ...this.page.choices.reading(), "-o", "corrected.csv"];
        await this.finish("Correcting", words, this.other);
    }

    async evaluate() {
        const [name] = this.calibration;
        const words = ["evaluate", ...recordings(this.other), "--calibration", `this=${name}`, "--report", "evaluation.html"];
        await this.finish("Evaluating", words, this.other);
    }

    /** Runs a call on the calibration and other files, and shows what it says and makes. */
    async finish(what, words, files) {
        const { page } = this;
        await page.guarded(async () => {
            const result = await page.busy.run(what, words, [...files, this.calibration]);
            const failure = failureOf(result);
            const report = result.files.find(([name]) => name.endsWith(".html"));
            const notes = [result.output, failure ? "" : result.error].join("\n").trim();
            show(
                $("done"),
                element("h2", {}, `${what} with ${this.calibration[0]}`),
                copied(commandLine(words)),
                failure ? failureView(failure, () => {}) : null,
                element("p", { className: "choices" }, result.files.map(([name, bytes]) => saved(name, bytes))),
                notes && !report ? element("pre", { tabIndex: 0 }, notes) : null,
                ...(report ? reportViews(new TextDecoder().decode(report[1])) : []),
            );
            focus($("done"));
        });
    }

    showOther() {
        const names = this.other ? recordings(this.other).join(", ") : "";
        $("other-name").textContent = names || "no file chosen";
        $("correct").disabled = !this.other;
        $("evaluate").disabled = !this.other;
    }
}
