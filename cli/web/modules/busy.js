// What is said while the program runs, and the button that ends it.
import { Cancelled, Replaced } from "./program.js";

const STAGES = {
    cutting: "looking for static intervals and turns",
    fitting: "fitting",
    searching: "trying effects",
    simulating: "simulating",
    correcting: "correcting readings",
};

/** One run at a time, with its progress. */
export class Busy {
    constructor(section, program) {
        this.section = section;
        this.program = program;
        [this.stage, this.count] = section.querySelectorAll("p span");
        this.running = undefined;
        section.querySelector("button").addEventListener("click", () => this.end(new Cancelled("cancelled")));
        document.addEventListener("keydown", (event) => {
            if (event.key === "Escape") {
                this.end(new Cancelled("cancelled"));
            }
        });
    }

    /** Ends what runs, for a reason. */
    end(reason) {
        this.running?.abort.abort(reason);
    }

    /** Runs a call in place of what runs already; the same call is not begun again. */
    async run(what, words, files) {
        const isSame = this.running?.files === files && this.running.words.join("\n") === words.join("\n");
        if (isSame) {
            throw new Replaced("the same runs already");
        }
        this.end(new Replaced("replaced"));
        const running = { abort: new AbortController(), words, files };
        this.running = running;
        const begin = performance.now();
        let steps = "";
        this.stage.textContent = what;
        const say = () => {
            const seconds = ((performance.now() - begin) / 1000).toFixed(0);
            this.count.textContent = `${steps}, ${seconds} s`;
        };
        const timer = setInterval(say, 250);
        say();
        this.section.hidden = false;
        document.body.setAttribute("aria-busy", "true");
        const told = (progress) => {
            const stage = `${what}: ${STAGES[progress.stage] ?? progress.stage}`;
            steps = `, step ${progress.steps}`;
            // Only what changes is read out.
            if (this.stage.textContent !== stage) {
                this.stage.textContent = stage;
            }
        };
        try {
            return await this.program.run(words, files, told, running.abort.signal);
        } finally {
            clearInterval(timer);
            if (this.running === running) {
                this.running = undefined;
                this.section.hidden = true;
                document.body.removeAttribute("aria-busy");
            }
        }
    }
}
