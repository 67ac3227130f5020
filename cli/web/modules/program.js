// The command line's program, run on files of the page.

/** The end of a run that a person cancelled. */
export class Cancelled extends Error {}

/** The end of a run that another one took the place of. */
export class Replaced extends Error {}

/** The program, which the page carries as base64 of its compressed bytes. */
export class Program {
    constructor(element, worker) {
        this.element = element;
        this.script = URL.createObjectURL(new Blob([worker.textContent], { type: "text/javascript" }));
        this.module = undefined;
    }

    /** The compiled module. It is unpacked at the first call. */
    compiled() {
        this.module ??= unpacked(this.element.textContent).then((bytes) => WebAssembly.compile(bytes));
        return this.module;
    }

    /** Runs a call; `told` hears of its progress, and `signal` ends it. */
    async run(words, files, told = () => {}, signal = undefined) {
        const module = await this.compiled();
        signal?.throwIfAborted();
        const worker = new Worker(this.script);
        try {
            return await new Promise((resolve, reject) => {
                signal?.addEventListener("abort", () => reject(signal.reason));
                worker.onerror = (event) => reject(new Error(event.message));
                worker.onmessage = ({ data }) => {
                    if (data.progress) {
                        told(data.progress);
                    } else {
                        resolve(data.result);
                    }
                };
                worker.postMessage({ module, words, files });
            });
        } finally {
            worker.terminate();
        }
    }
}

async function unpacked(base64) {
    const text = atob(base64.trim());
    const bytes = new Uint8Array(text.length);
    for (let k = 0; k < text.length; k += 1) {
        bytes[k] = text.charCodeAt(k);
    }
    const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"));
    return new Response(stream).arrayBuffer();
}
