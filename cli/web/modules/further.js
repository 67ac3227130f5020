// What can be done with a calibration: look for what it lacks, export it, correct or judge another recording with it, keep it.
import { parsed } from "./documents.js";
import { chosen, recordings, tooLarge } from "./dropped.js";
import { copied, element, focus, saved, show } from "./elements.js";
import { failureOf, failureView } from "./failure_view.js";
import { Kept } from "./kept.js";
import { RESULTS, named } from "./names.js";
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
        this.kept = new Kept($("kept"), (name, bytes) => this.use(name, bytes));
        $("target").append(...TARGETS.map(([value, name]) => element("option", { value }, name)));
        $("discover").addEventListener("click", () => this.discover());
        $("export").addEventListener("click", () => this.export());
        $("choose-other").addEventListener("click", () => $("other").click());
        $("other").addEventListener("change", () => {
            this.takeOther(chosen($("other").files));
            $("other").value = "";
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

    /** Offers what can be done with a calibration that was dropped, if the program reads it; gives the failures. */
    async takeCalibration([[, file]]) {
        return this.checked(file.name, new Uint8Array(await file.arrayBuffer()));
    }

    /** The same for one that was kept; a failure is said. */
    async use(name, bytes) {
        await this.page.guarded(async () => {
            const failures = await this.checked(name, bytes);
            this.page.say(failures.map(({ message }) => message).join(" "));
        });
    }

    async checked(name, bytes) {
        const [calibration] = named([[[name, bytes]]]);
        const words = ["export", calibration[0], "--to", "toml", "-o", "read.toml"];
        const failure = failureOf(await this.page.busy.run(`Reading ${name}`, words, [calibration]));
        if (failure) {
            return [failure];
        }
        this.offer(...calibration);
        return [];
    }

    /** Takes another recording, if it is not too large. */
    takeOther(things) {
        const files = things.flat();
        const refused = tooLarge(files);
        this.other = refused || files.length === 0 ? undefined : things;
        if (refused) {
            const words = ["apply", this.calibration[0], ...recordings(files), "-o", "corrected.csv"];
            show($("done"), failureView({ message: refused }, this.page), copied(commandLine(words)));
        }
        this.showOther();
        $(refused ? "choose-other" : "correct").focus();
    }

    /** Its files, under names that are free beside the calibration. */
    otherFiles() {
        return named(this.other, [...RESULTS, this.calibration[0]]);
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
                failure ? failureView(failure, page, () => this.discover()) : null,
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
        const [name] = this.calibration;
        await this.finish("Planning", `Plan after ${name}`, ["plan", name], [], () => this.plan());
    }

    async export() {
        const [target, , file] = TARGETS.find(([value]) => value === $("target").value);
        const [name] = this.calibration;
        await this.finish("Exporting", `Export of ${name}`, ["export", name, "--to", target, "-o", file], [], () => this.export());
    }

    async correct() {
        const [name] = this.calibration;
        const files = this.otherFiles();
        const words = ["apply", name, ...recordings(files), ...this.page.choices.reading(), "-o", "corrected.csv"];
        await this.finish("Correcting", `Correction with ${name}`, words, files, () => this.correct());
    }

    async evaluate() {
        const [name] = this.calibration;
        const files = this.otherFiles();
        const options = this.page.choices.reading();
        const words = ["evaluate", ...recordings(files), ...options, "--calibration", `cal=${name}`, "--report", "evaluation.html"];
        await this.finish("Evaluating", `Evaluation of ${name}`, words, files, () => this.evaluate());
    }

    /** Runs a call on the calibration and other files, and shows under a title what it says and makes. */
    async finish(doing, title, words, files, again) {
        const { page } = this;
        await page.guarded(async () => {
            const result = await page.busy.run(doing, words, [...files, this.calibration]);
            const failure = failureOf(result);
            const report = result.files.find(([name]) => name.endsWith(".html"));
            const notes = [result.output, failure ? "" : result.error].join("\n").trim();
            show(
                $("done"),
                element("h2", {}, title),
                copied(commandLine(words)),
                failure ? failureView(failure, page, again) : null,
                element("p", { className: "choices" }, result.files.map(([name, bytes]) => saved(name, bytes))),
                notes && !report ? element("pre", { tabIndex: 0 }, notes) : null,
                ...(report ? reportViews(new TextDecoder().decode(report[1])) : []),
            );
            focus($("done"));
        });
    }

    showOther() {
        const names = this.other ? recordings(this.other.flat()).join(", ") : "";
        $("other-name").textContent = names || "no file chosen";
        $("correct").disabled = !this.other;
        $("evaluate").disabled = !this.other;
    }
}
