// The page: drop a recording, see what is in it, calibrate it.
import { Busy } from "./busy.js";
import { Choices } from "./choices.js";
import { isCalibration, parsed } from "./documents.js";
import { apart, chosen, dropped, joined, recordings, tooLarge } from "./dropped.js";
import { button, copied, element, focus, saved, show } from "./elements.js";
import { failureOf, failureView } from "./failure_view.js";
import { Further } from "./further.js";
import { infoView, optionsOf } from "./info_view.js";
import { RESULTS, named, renamed } from "./names.js";
import { Cancelled, Program, Replaced } from "./program.js";
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
        $("look").addEventListener("click", () => this.again());
    }

    /** Takes what was dropped or chosen in place of what was there. */
    take(things) {
        const files = named(things);
        if (files.length === 0) {
            return;
        }
        this.busy.end(new Replaced("replaced"));
        this.say("");
        this.files = files;
        this.again = () => this.look();
        this.choices.clear();
        this.forget();
        $("choices").hidden = true;
        show($("what"));
        const refused = tooLarge(files);
        $("recording").hidden = !refused;
        if (refused) {
            const line = commandLine(["calibrate", ...recordings(files), "-o", "cal.json"]);
            show($("what"), failureView({ message: refused }, this), copied(line));
            return;
        }
        this.look();
    }

    /** Takes a result away that is not of what is read now. */
    forget() {
        this.results = undefined;
        $("result").hidden = true;
        show($("pictures"));
        this.further.hide();
    }

    /** A simulated recording, for those who have none at hand. */
    async simulate() {
        await this.guarded(async () => {
            const result = await this.busy.run("Simulating", ["demo", "--out", "demo"], []);
            const made = result.files.find(([path]) => path === "demo/recording.csv");
            if (made) {
                this.take([[["recording.csv", new File([made[1]], "recording.csv")]]]);
            }
        });
    }

    /** Shows what is in the files. */
    async look() {
        await this.guarded(async () => {
            const seen = [];
            for (const name of recordings(this.files)) {
                const words = ["info", name, ...this.choices.reading()];
                const result = await this.busy.run(`Reading ${name}`, [...words, "--json"], this.files);
                seen.push([words, result]);
            }
            this.forget();
            await this.shown(seen);
        });
    }

    async shown(seen) {
        const documents = seen.flatMap(([, { output }]) => parsed(output)?.files ?? []);
        const ours = documents.filter((document) => document.format?.startsWith("stillpoint."));
        const failures = seen.map(([, result]) => failureOf(result)).filter(Boolean);
        if (failures.length === 0 && documents.length > 0 && documents.every(({ format }) => isCalibration(format))) {
            failures.push(...(await this.further.takeCalibration(this.files)));
        } else {
            this.files = joined(named(apart(this.files), RESULTS), documents);
        }
        // A log of several sensors has been read as far as this: which of them is asked.
        const options = optionsOf(documents.flatMap((document) => document.streams ?? []));
        const asked = options.map((line) => button(`Use ${line}`, () => this.choose(line, false)));
        show(
            $("what"),
            ...documents.map(infoView),
            element("p", {}, renamed(this.files)),
            asked.length > 0 ? element("p", { className: "choices" }, "Choose one: ", asked) : null,
            ...failures.map((failure) => failureView(failure, this)),
            copied(commandLine(seen.length === 1 ? seen[0][0] : ["info", ...recordings(this.files), ...this.choices.reading()])),
        );
        const isReadable = documents.some((document) => document.sensors);
        $("choices").hidden = ours.length > 0 || (documents.length === 0 && failures.length === 0);
        $("recording").hidden = false;
        $("choices").classList.toggle("unread", !isReadable);
        $("calibrate").disabled = !isReadable;
        this.showCommand();
        focus($("recording"));
    }

    /** An option that a message has offered, and what is done `again` with it; what is left open in it is a person's to complete. */
    choose(line, isOpen, again = () => (this.choices.isReading(line) ? this.look() : this.calibrate())) {
        if (isOpen) {
            this.again = again;
            $("choices").hidden = false;
            this.choices.complete(line);
            this.showCommand();
            return;
        }
        this.choices.add(line);
        this.showCommand();
        again();
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
            const words = this.words();
            const result = await this.busy.run("Calibrating", [...words, "--json"], this.files);
            this.forget();
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
            ...(document ? [next, head] : [head, next]),
            failure ? failureView(failure, this, undefined, Boolean(report)) : null,
            links.length > 0 ? element("p", { className: "choices" }, links) : null,
        ];
    }

    /** Work that may fail or be cancelled. */
    async guarded(work) {
        this.say("");
        try {
            await work();
        } catch (error) {
            if (error instanceof Cancelled) {
                this.say("Cancelled. Nothing was changed.");
            } else if (!(error instanceof Replaced)) {
                this.say(`This did not work: ${error.message ?? error}. Load the page again.`);
            }
        }
    }

    /** Says what went wrong; nothing where the text is empty. */
    say(problem) {
        $("problem").textContent = problem;
        $("problem").hidden = problem === "";
    }
}

new Page();
document.documentElement.dataset.ready = "true";
