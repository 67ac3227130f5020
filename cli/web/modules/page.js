// The page: drop a recording, see what is in it, calibrate it.
import { Busy } from "./busy.js";
import { Choices } from "./choices.js";
import { chosen, dropped, joined, recordings, tooLarge } from "./dropped.js";
import { button, copied, element, focus, saved, show } from "./elements.js";
import { failureOf, failureView, parsed } from "./failure_view.js";
import { Further } from "./further.js";
import { infoView, optionsOf } from "./info_view.js";
import { Cancelled, Program } from "./program.js";
import { commandLine } from "./shell_words.js";
import { verdictView } from "./verdict_view.js";
import { reportViews } from "./report_view.js";

const $ = (id) => document.getElementById(id);

/** The page's state: the files at hand and what was made of them. */
class Page {
    constructor() {
        this.program = new Program($("program"), $("worker"));
        this.busy = new Busy($("busy"), this.program);
        this.choices = new Choices($("choices"), () => this.showCommand());
        this.further = new Further(this);
        this.files = [];
        this.listen();
    }

    listen() {
        const zone = $("drop");
        addEventListener("dragover", (event) => {
            event.preventDefault();
            zone.classList.add("over");
        });
        addEventListener("dragleave", () => zone.classList.remove("over"));
        addEventListener("drop", async (event) => {
            event.preventDefault();
            zone.classList.remove("over");
            this.take(await dropped(event.dataTransfer));
        });
        for (const [field, pressed] of [["files", "choose-files"], ["folder", "choose-folder"]]) {
            $(pressed).addEventListener("click", () => $(field).click());
            $(field).addEventListener("change", () => {
                this.take(chosen($(field).files));
                $(field).value = "";
            });
        }
        $("try").addEventListener("click", () => this.simulate());
        $("choices").addEventListener("submit", (event) => {
            event.preventDefault();
            this.calibrate();
        });
        $("look").addEventListener("click", () => this.look());
    }

    /** Takes files of a drop or a field. */
    take(files) {
        if (files.length === 0) {
            return;
        }
        this.files = files;
        this.choices.clear();
        this.results = undefined;
        $("result").hidden = true;
        show($("pictures"));
        this.further.hide();
        const refused = tooLarge(files);
        if (refused) {
            $("recording").hidden = false;
            $("choices").hidden = true;
            const line = commandLine(["calibrate", ...recordings(files), "-o", "cal.json"]);
            show($("what"), failureView({ message: refused }, () => {}), copied(line));
            return;
        }
        this.look();
    }

    /** A simulated recording, for those who have none at hand. */
    async simulate() {
        await this.guarded(async () => {
            const result = await this.busy.run("Simulating", ["demo", "--out", "demo"], []);
            const made = result.files.find(([path]) => path === "demo/recording.csv");
            if (made) {
                this.take([["recording.csv", new File([made[1]], "recording.csv")]]);
            }
        });
    }

    /** Shows what is in the files. */
    async look() {
        await this.guarded(async () => {
            $("recording").hidden = false;
            $("choices").hidden = true;
            show($("what"));
            const seen = [];
            for (const name of recordings(this.files)) {
                const words = ["info", name, ...this.choices.reading()];
                const result = await this.busy.run(`Reading ${name}`, [...words, "--json"], this.files);
                seen.push([words, result]);
            }
            this.shown(seen);
        });
    }

    shown(seen) {
        const documents = seen.flatMap(([, { output }]) => parsed(output)?.files ?? []);
        const ours = documents.filter((document) => document.format?.startsWith("stillpoint."));
        const failures = seen.map(([, result]) => failureOf(result)).filter(Boolean);
        if (ours.length > 0 && ours.length === documents.length) {
            this.further.takeCalibration(this.files);
        }
        this.files = joined(this.files, documents);
        const choose = (line, isOpen) => this.choose(line, isOpen);
        // A log of several sensors has been read as far as this: which of them is asked.
        const options = optionsOf(documents.flatMap((document) => document.streams ?? []));
        const asked = options.map((line) => button(`Use ${line}`, () => choose(line, false)));
        show(
            $("what"),
            ...documents.map(infoView),
            asked.length > 0 ? element("p", { className: "choices" }, "Choose one: ", asked) : null,
            ...failures.map((failure) => failureView(failure, choose)),
            copied(commandLine(seen.length === 1 ? seen[0][0] : ["info", ...recordings(this.files), ...this.choices.reading()])),
        );
        const isReadable = documents.some((document) => document.sensors);
        $("choices").hidden = ours.length > 0 || (documents.length === 0 && failures.length === 0);
        $("calibrate").disabled = !isReadable;
        this.showCommand();
        focus($("recording"));
    }

    /** An option that a message has offered; what is left open in it is a person's to complete. */
    choose(line, isOpen) {
        if (isOpen) {
            this.choices.complete(line);
            this.showCommand();
            return;
        }
        this.choices.add(line);
        if (this.choices.isReading(line)) {
            this.look();
        } else {
            this.calibrate();
        }
    }

    /** The call that is equal to the button. */
    words() {
        return ["calibrate", ...recordings(this.files), ...this.choices.words(), "-o", "cal.json", "--report", "report.html"];
    }

    showCommand() {
        show($("command"), copied(commandLine(this.words())));
    }

    async calibrate() {
        await this.guarded(async () => {
            this.further.hide();
            const words = this.words();
            const result = await this.busy.run("Calibrating", [...words, "--json"], this.files);
            this.results = new Map(result.files);
            const calibration = this.results.get("cal.json");
            $("result").hidden = false;
            show($("verdict"), ...this.resultView(result, calibration));
            focus($("result"));
            if (calibration) {
                this.further.offer("cal.json", calibration);
            }
        });
    }

    resultView(result, calibration) {
        const failure = failureOf(result);
        const report = this.results.get("report.html");
        const text = report ? new TextDecoder().decode(report) : "";
        const document = calibration ? parsed(new TextDecoder().decode(calibration)) : undefined;
        const links = [...this.results].map(([name, bytes]) => saved(name, bytes));
        const [head, rest] = report ? reportViews(text) : [null, null];
        show($("pictures"), rest);
        const next = verdictView(document, head, this);
        return [
            failure ? failureView(failure, (line, isOpen) => this.choose(line, isOpen), report && !calibration) : null,
            ...(document ? [next, head] : [head, next]),
            links.length > 0 ? element("p", { className: "choices" }, links) : null,
        ];
    }

    /** Work that may fail or be cancelled. */
    async guarded(work) {
        const problem = $("problem");
        problem.hidden = true;
        try {
            await work();
        } catch (error) {
            if (error instanceof Cancelled) {
                problem.textContent = "Cancelled. Nothing was changed.";
            } else {
                problem.textContent = `This did not work: ${error.message ?? error}. Load the page again.`;
            }
            problem.hidden = false;
        }
    }
}

new Page();
document.documentElement.dataset.ready = "true";
