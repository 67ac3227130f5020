// A host for programs of WASI, preview 1: files in memory, the clock, chance, and nothing else of the machine.
import { Descriptors, STATUS } from "./descriptors.js";

/** The end of a program. */
export class Exit extends Error {
    constructor(code) {
        super(`exit ${code}`);
        this.code = code;
    }
}

/** One run of a program. */
export class Host extends Descriptors {
    /** With the words of its call, its variables, its files, and who is given what it says. */
    constructor(words, variables, root, outputs) {
        super(root, outputs);
        this.words = words;
        this.variables = variables;
    }

    /** Runs a module to its end and gives its exit status. */
    run(module) {
        const imports = {};
        for (const { module: from, name } of WebAssembly.Module.imports(module)) {
            imports[from] ??= {};
            imports[from][name] = this[name] ? (...all) => this[name](...all) : () => STATUS.notHere;
        }
        const instance = new WebAssembly.Instance(module, imports);
        this.memory = instance.exports.memory;
        try {
            instance.exports._start();
        } catch (end) {
            if (end instanceof Exit) {
                return end.code;
            }
            throw end;
        }
        return 0;
    }

    // Words and variables.

    args_sizes_get(count, size) {
        return this.sizes(this.words, count, size);
    }

    args_get(pointers, buffer) {
        return this.strings(this.words, pointers, buffer);
    }

    environ_sizes_get(count, size) {
        return this.sizes(this.variables, count, size);
    }

    environ_get(pointers, buffer) {
        return this.strings(this.variables, pointers, buffer);
    }

    sizes(all, count, size) {
        const encoded = all.map((text) => new TextEncoder().encode(text).length + 1);
        this.view.setUint32(count, all.length, true);
        this.view.setUint32(size, encoded.reduce((sum, length) => sum + length, 0), true);
        return STATUS.ok;
    }

    strings(all, pointers, buffer) {
        for (const text of all) {
            const encoded = new TextEncoder().encode(`${text}\0`);
            this.view.setUint32(pointers, buffer, true);
            this.bytes(buffer, encoded.length).set(encoded);
            pointers += 4;
            buffer += encoded.length;
        }
        return STATUS.ok;
    }

    // Clock, chance, end.

    clock_time_get(id, _precision, at) {
        const milliseconds = id === 0 ? Date.now() : performance.now();
        this.view.setBigUint64(at, BigInt(Math.round(milliseconds * 1e6)), true);
        return STATUS.ok;
    }

    random_get(at, length) {
        for (let done = 0; done < length; done += 65536) {
            crypto.getRandomValues(this.bytes(at + done, Math.min(65536, length - done)));
        }
        return STATUS.ok;
    }

    sched_yield() {
        return STATUS.ok;
    }

    /** A wait is over at once: nothing happens elsewhere meanwhile. */
    poll_oneoff(subscriptions, events, count, happened) {
        for (let k = 0; k < count; k += 1) {
            const [from, to] = [subscriptions + 48 * k, events + 32 * k];
            this.bytes(to, 32).fill(0);
            this.view.setBigUint64(to, this.view.getBigUint64(from, true), true);
            this.view.setUint8(to + 10, this.view.getUint8(from + 8));
        }
        this.view.setUint32(happened, count, true);
        return STATUS.ok;
    }

    proc_exit(code) {
        throw new Exit(code);
    }
}
