// Files and folders in memory, as a program sees them.

/** Bytes that are read ahead of a file on the disk. */
const AHEAD = 4 << 20;

/** A file that cannot be read any more. */
export class Gone extends Error {}

/** A file that a person chose: read where it is asked for, never held as a whole. */
export class ChosenFile {
    constructor(blob) {
        this.blob = blob;
        this.begin = 0;
        this.held = new Uint8Array(0);
    }

    get size() {
        return this.blob.size;
    }

    /** The bytes from `at` on, at most `length`; fewer where what is held ends before. */
    read(at, length) {
        const offset = at - this.begin;
        if (offset < 0 || offset >= this.held.length) {
            const part = this.blob.slice(at, at + Math.max(length, AHEAD));
            this.held = new Uint8Array(this.bytesOf(part));
            this.begin = at;
        }
        const from = at - this.begin;
        return this.held.subarray(from, from + length);
    }

    bytesOf(part) {
        try {
            return new FileReaderSync().readAsArrayBuffer(part);
        } catch {
            throw new Gone(`${this.blob.name} was changed or removed after it was chosen; choose it again`);
        }
    }
}

/** A file that a program writes, or whose bytes are here already. */
export class HeldFile {
    constructor(bytes = new Uint8Array(0)) {
        this.bytes = bytes;
        this.size = bytes.length;
    }

    read(at, length) {
        return this.bytes.subarray(at, Math.min(at + length, this.size));
    }

    write(at, bytes) {
        this.resize(Math.max(this.size, at + bytes.length));
        this.bytes.set(bytes, at);
    }

    resize(size) {
        if (size > this.bytes.length) {
            const grown = new Uint8Array(Math.max(size, 2 * this.bytes.length));
            grown.set(this.bytes.subarray(0, this.size));
            this.bytes = grown;
        } else if (size < this.size) {
            this.bytes.fill(0, size, this.size);
        }
        this.size = size;
    }

    /** What is in it. */
    content() {
        return this.bytes.slice(0, this.size);
    }
}

/** A folder. */
export class Folder {
    constructor() {
        this.entries = new Map();
    }

    /** The node at a path, or undefined. */
    at(path) {
        let node = this;
        for (const name of parts(path)) {
            node = node instanceof Folder ? node.entries.get(name) : undefined;
        }
        return node;
    }

    /** The folder that a path lies in, and the path's last part. */
    parent(path) {
        const names = parts(path);
        const last = names.pop();
        return [this.at(names.join("/")), last];
    }

    /** Puts a file at a path and makes the folders on the way. */
    put(path, file) {
        const names = parts(path);
        const last = names.pop();
        let folder = this;
        for (const name of names) {
            if (!(folder.entries.get(name) instanceof Folder)) {
                folder.entries.set(name, new Folder());
            }
            folder = folder.entries.get(name);
        }
        folder.entries.set(last, file);
    }

    /** Every file of the folder and of those in it, by its path. */
    *files(before = "") {
        for (const [name, node] of this.entries) {
            if (node instanceof Folder) {
                yield* node.files(`${before}${name}/`);
            } else {
                yield [before + name, node];
            }
        }
    }
}

function parts(path) {
    const names = [];
    for (const name of path.split("/")) {
        if (name === "..") {
            names.pop();
        } else if (name !== "" && name !== ".") {
            names.push(name);
        }
    }
    return names;
}
