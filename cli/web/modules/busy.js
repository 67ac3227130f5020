// What is said while the program runs, and the button that ends it.
import { Cancelled } from "./program.js";

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
        this.text = section.querySelector("p");
        this.abort = undefined;
        section.querySelector("button").addEventListener("click", () => this.cancel());
        document.addEventListener("keydown", (event) => {
            if (event.key === "Escape") {
                this.cancel();
            }
        });
    }

    cancel() {
        this.abort?.abort(new Cancelled("cancelled"));
    }

    /** Runs a call; what runs already is cancelled. */
    async run(what, words, files) {
        this.cancel();
        const abort = new AbortController();
        this.abort = abort;
        const begin = performance.now();
        let doing = "";
        const say = () => {
            const seconds = ((performance.now() - begin) / 1000).toFixed(0);
            this.text.textContent = `${what}${doing}, ${seconds} s`;
        };
        const timer = setInterval(say, 250);
        say();
        this.section.hidden = false;
        document.body.setAttribute("aria-busy", "true");
        const told = ({ stage, steps }) => {
            doing = `: ${STAGES[stage] ?? stage}, step ${steps}`;
        };
        try {
            return await this.program.run(words, files, told, abort.signal);
        } finally {
            clearInterval(timer);
            if (this.abort === abort) {
                this.abort = undefined;
                this.section.hidden = true;
                document.body.removeAttribute("aria-busy");
            }
        }
    }
}
