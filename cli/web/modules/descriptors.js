// Files and folders by descriptor and by path, as WASI (preview 1) asks for them.
import { Folder, HeldFile } from "./file_tree.js";

/** Statuses of WASI. */
export const STATUS = {
    ok: 0,
    badDescriptor: 8,
    exists: 20,
    invalid: 28,
    isFolder: 31,
    notThere: 44,
    notHere: 52,
    noFolder: 54,
    notEmpty: 55,
    noSeek: 70,
};

const TYPE_UNKNOWN = 0;
const TYPE_FOLDER = 3;
const TYPE_FILE = 4;

const CREATE = 1;
const FOLDER_ONLY = 2;
const EXCLUSIVE = 4;
const TRUNCATE = 8;
const APPEND = 1;

/** The descriptor of the root folder: after standard input, output and error. */
const ROOT = 3;

/** A program's files, and the memory that it names them in. */
export class Descriptors {
    /** With its files, and who is given what it says on output (1) and on error (2). */
    constructor(root, outputs) {
        this.root = root;
        this.outputs = outputs;
        this.open = new Map([[ROOT, { node: root, path: "", at: 0 }]]);
        this.next = ROOT + 1;
        this.memory = undefined;
    }

    get view() {
        return new DataView(this.memory.buffer);
    }

    bytes(at, length) {
        return new Uint8Array(this.memory.buffer, at, length);
    }

    /** A path, from the root folder on. */
    path(fd, at, length) {
        const name = new TextDecoder().decode(this.bytes(at, length));
        return `${this.open.get(fd)?.path ?? ""}/${name}`;
    }

    fd_prestat_get(fd, at) {
        if (fd !== ROOT) {
            return STATUS.badDescriptor;
        }
        this.view.setUint32(at, 0, true);
        this.view.setUint32(at + 4, 1, true);
        return STATUS.ok;
    }

    fd_prestat_dir_name(fd, at) {
        if (fd !== ROOT) {
            return STATUS.badDescriptor;
        }
        this.view.setUint8(at, "/".charCodeAt(0));
        return STATUS.ok;
    }

    fd_fdstat_get(fd, at) {
        const handle = this.open.get(fd);
        if (!handle && fd >= ROOT) {
            return STATUS.badDescriptor;
        }
        this.bytes(at, 24).fill(0);
        this.view.setUint8(at, handle ? type(handle.node) : TYPE_UNKNOWN);
        this.view.setUint16(at + 2, handle?.append ? APPEND : 0, true);
        this.bytes(at + 8, 16).fill(0xff);
        return STATUS.ok;
    }

    fd_fdstat_set_flags() {
        return STATUS.ok;
    }

    fd_filestat_get(fd, at) {
        const handle = this.open.get(fd);
        if (!handle && fd >= ROOT) {
            return STATUS.badDescriptor;
        }
        return this.stat(handle?.node, at);
    }

    stat(node, at) {
        this.bytes(at, 64).fill(0);
        this.view.setUint8(at + 16, type(node));
        this.view.setBigUint64(at + 24, 1n, true);
        this.view.setBigUint64(at + 32, BigInt(node?.size ?? 0), true);
        return STATUS.ok;
    }

    fd_filestat_set_size(fd, size) {
        const handle = this.open.get(fd);
        if (!(handle?.node instanceof HeldFile)) {
            return STATUS.invalid;
        }
        handle.node.resize(Number(size));
        return STATUS.ok;
    }

    fd_filestat_set_times() {
        return STATUS.ok;
    }

    path_filestat_set_times() {
        return STATUS.ok;
    }

    fd_advise() {
        return STATUS.ok;
    }

    fd_allocate() {
        return STATUS.ok;
    }

    fd_sync() {
        return STATUS.ok;
    }

    fd_datasync() {
        return STATUS.ok;
    }

    fd_close(fd) {
        return this.open.delete(fd) || fd < ROOT ? STATUS.ok : STATUS.badDescriptor;
    }

    fd_renumber(from, to) {
        this.open.set(to, this.open.get(from));
        this.open.delete(from);
        return STATUS.ok;
    }

    fd_seek(fd, offset, whence, at) {
        const handle = this.open.get(fd);
        if (!handle) {
            return fd < ROOT ? STATUS.noSeek : STATUS.badDescriptor;
        }
        const from = [0, handle.at, handle.node.size][whence];
        const to = from + Number(offset);
        if (!(to >= 0)) {
            return STATUS.invalid;
        }
        handle.at = to;
        this.view.setBigUint64(at, BigInt(to), true);
        return STATUS.ok;
    }

    fd_tell(fd, at) {
        return this.fd_seek(fd, 0n, 1, at);
    }

    /** The parts of memory that a list of them names. */
    *vectors(list, count) {
        for (let k = 0; k < count; k += 1) {
            const at = this.view.getUint32(list + 8 * k, true);
            const length = this.view.getUint32(list + 8 * k + 4, true);
            yield this.bytes(at, length);
        }
    }

    fd_read(fd, list, count, done) {
        const handle = this.open.get(fd);
        const read = handle ? this.read(handle.node, handle.at, list, count, done) : STATUS.ok;
        if (!handle) {
            // Standard input is empty.
            this.view.setUint32(done, 0, true);
            return fd === 0 ? STATUS.ok : STATUS.badDescriptor;
        }
        handle.at += this.view.getUint32(done, true);
        return read;
    }

    fd_pread(fd, list, count, at, done) {
        const handle = this.open.get(fd);
        return handle ? this.read(handle.node, Number(at), list, count, done) : STATUS.badDescriptor;
    }

    read(node, at, list, count, done) {
        if (node instanceof Folder) {
            return STATUS.isFolder;
        }
        let total = 0;
        for (const into of this.vectors(list, count)) {
            const bytes = node.read(at + total, into.length);
            into.set(bytes);
            total += bytes.length;
            if (bytes.length < into.length) {
                break;
            }
        }
        this.view.setUint32(done, total, true);
        return STATUS.ok;
    }

    fd_write(fd, list, count, done) {
        const handle = this.open.get(fd);
        if (handle) {
            const at = handle.append ? handle.node.size : handle.at;
            const written = this.write(handle.node, at, list, count, done);
            handle.at = at + (written === STATUS.ok ? this.view.getUint32(done, true) : 0);
            return written;
        }
        if (fd !== 1 && fd !== 2) {
            return STATUS.badDescriptor;
        }
        let total = 0;
        for (const bytes of this.vectors(list, count)) {
            this.outputs[fd](bytes.slice());
            total += bytes.length;
        }
        this.view.setUint32(done, total, true);
        return STATUS.ok;
    }

    fd_pwrite(fd, list, count, at, done) {
        const handle = this.open.get(fd);
        return handle ? this.write(handle.node, Number(at), list, count, done) : STATUS.badDescriptor;
    }

    write(node, at, list, count, done) {
        if (!(node instanceof HeldFile)) {
            return STATUS.badDescriptor;
        }
        let total = 0;
        for (const bytes of this.vectors(list, count)) {
            node.write(at + total, bytes);
            total += bytes.length;
        }
        this.view.setUint32(done, total, true);
        return STATUS.ok;
    }

    fd_readdir(fd, buffer, length, cookie, used) {
        const folder = this.open.get(fd)?.node;
        if (!(folder instanceof Folder)) {
            return STATUS.noFolder;
        }
        let filled = 0;
        const entries = [...folder.entries].slice(Number(cookie));
        for (const [k, [name, node]] of entries.entries()) {
            const encoded = new TextEncoder().encode(name);
            const entry = new Uint8Array(24 + encoded.length);
            const view = new DataView(entry.buffer);
            view.setBigUint64(0, cookie + BigInt(k + 1), true);
            view.setUint32(16, encoded.length, true);
            view.setUint8(20, type(node));
            entry.set(encoded, 24);
            // A last entry that does not fit tells the reader that there is more.
            const fits = entry.subarray(0, length - filled);
            this.bytes(buffer + filled, fits.length).set(fits);
            filled += fits.length;
        }
        this.view.setUint32(used, filled, true);
        return STATUS.ok;
    }

    // Paths.

    path_filestat_get(fd, _flags, at, length, stat) {
        const node = this.root.at(this.path(fd, at, length));
        return node ? this.stat(node, stat) : STATUS.notThere;
    }

    path_open(fd, _links, at, length, how, _rights, _inherited, flags, opened) {
        const path = this.path(fd, at, length);
        let node = this.root.at(path);
        if (node && how & EXCLUSIVE) {
            return STATUS.exists;
        }
        if (how & FOLDER_ONLY && node && !(node instanceof Folder)) {
            return STATUS.noFolder;
        }
        if (!node) {
            const [folder, name] = this.root.parent(path);
            if (!(how & CREATE) || !(folder instanceof Folder)) {
                return STATUS.notThere;
            }
            node = new HeldFile();
            folder.entries.set(name, node);
        }
        if (how & TRUNCATE && node instanceof HeldFile) {
            node.resize(0);
        }
        this.open.set(this.next, { node, path, at: 0, append: Boolean(flags & APPEND) });
        this.view.setUint32(opened, this.next, true);
        this.next += 1;
        return STATUS.ok;
    }

    path_create_directory(fd, at, length) {
        const path = this.path(fd, at, length);
        const [folder, name] = this.root.parent(path);
        if (!(folder instanceof Folder)) {
            return STATUS.notThere;
        }
        if (!name || folder.entries.has(name)) {
            return STATUS.exists;
        }
        folder.entries.set(name, new Folder());
        return STATUS.ok;
    }

    path_remove_directory(fd, at, length) {
        const [folder, name] = this.root.parent(this.path(fd, at, length));
        const node = folder?.entries.get(name);
        if (!node) {
            return STATUS.notThere;
        }
        if (!(node instanceof Folder)) {
            return STATUS.noFolder;
        }
        if (node.entries.size > 0) {
            return STATUS.notEmpty;
        }
        folder.entries.delete(name);
        return STATUS.ok;
    }

    path_unlink_file(fd, at, length) {
        const [folder, name] = this.root.parent(this.path(fd, at, length));
        const node = folder?.entries.get(name);
        if (node instanceof Folder) {
            return STATUS.isFolder;
        }
        return folder?.entries.delete(name) ? STATUS.ok : STATUS.notThere;
    }

    path_rename(fd, at, length, other, toAt, toLength) {
        const moved = this.path_link(fd, 0, at, length, other, toAt, toLength, true);
        return moved === STATUS.ok ? this.path_unlink_file(fd, at, length) : moved;
    }

    path_link(fd, _flags, at, length, other, toAt, toLength, replace = false) {
        const node = this.root.at(this.path(fd, at, length));
        const [folder, name] = this.root.parent(this.path(other, toAt, toLength));
        if (!node || !(folder instanceof Folder)) {
            return STATUS.notThere;
        }
        if (!replace && folder.entries.has(name)) {
            return STATUS.exists;
        }
        folder.entries.set(name, node);
        return STATUS.ok;
    }

    /** There are no links. */
    path_readlink(fd, at, length) {
        return this.root.at(this.path(fd, at, length)) ? STATUS.invalid : STATUS.notThere;
    }
}

function type(node) {
    if (node instanceof Folder) {
        return TYPE_FOLDER;
    }
    return node ? TYPE_FILE : TYPE_UNKNOWN;
}
