// One run of the program in a thread of its own, which the page ends to cancel.
import { ChosenFile, Folder, Gone, HeldFile } from "./file_tree.js";
import { Host } from "./wasi.js";

/** A line of progress begins so on standard error. */
const PROGRESS = "\u001eprogress ";

/** Runs the program with `files`, pairs of a path and a blob or bytes, and gives its status, its words and its new files. */
export function run(module, words, files, told) {
    const root = new Folder();
    const given = new Set();
    for (const [path, content] of files) {
        const file = content instanceof Uint8Array ? new HeldFile(content) : new ChosenFile(content);
        root.put(path, file);
        given.add(file);
    }
    const output = new Lines(() => false);
    const error = new Lines((line) => {
        const isProgress = line.startsWith(PROGRESS);
        if (isProgress) {
            const [stage, steps] = line.slice(PROGRESS.length).split(" ");
            told({ stage, steps: Number(steps) });
        }
        return isProgress;
    });
    const outputs = { 1: (bytes) => output.take(bytes), 2: (bytes) => error.take(bytes) };
    const host = new Host(["stillpoint", ...words], ["STILLPOINT_PROGRESS=1"], root, outputs);
    let [failure, gone] = [null, null];
    let code = 7;
    try {
        code = host.run(module);
    } catch (end) {
        failure = String(end);
        gone = end instanceof Gone ? end.message : null;
    }
    // What was begun and not ended is no result.
    const made = failure ? [] : [...root.files()].filter(([, file]) => !given.has(file));
    return {
        code,
        failure,
        gone,
        output: output.text(),
        error: error.text(),
        files: made.map(([path, file]) => [path, file.content()]),
    };
}

/** What a program says, without the lines that are taken out. */
class Lines {
    constructor(isTaken) {
        this.isTaken = isTaken;
        this.decoder = new TextDecoder();
        this.kept = [];
        this.begun = "";
    }

    take(bytes) {
        const lines = (this.begun + this.decoder.decode(bytes, { stream: true })).split("\n");
        this.begun = lines.pop();
        this.kept.push(...lines.filter((line) => !this.isTaken(line)));
    }

    text() {
        return [...this.kept, this.begun].join("\n");
    }
}

if (typeof WorkerGlobalScope !== "undefined" && self instanceof WorkerGlobalScope) {
    self.onmessage = ({ data: { module, words, files } }) => {
        const result = run(module, words, files, (progress) => self.postMessage({ progress }));
        const buffers = result.files.map(([, bytes]) => bytes.buffer);
        self.postMessage({ result }, buffers);
    };
}
