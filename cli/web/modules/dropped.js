// Files and folders that a person drops or chooses.

/** The most that is read, bytes. What is read takes several times as much of the browser's memory. */
export const LARGEST = 300e6;

/** What is dropped: of each thing its files, as pairs of a path and a file. Folders are followed. */
export async function dropped(transfer) {
    const entries = [...transfer.items].map((item) => item.webkitGetAsEntry?.()).filter(Boolean);
    if (entries.length === 0) {
        return chosen(transfer.files);
    }
    return Promise.all(entries.map((entry) => inEntry(entry, "")));
}

/** The same of a field, which has files or one folder. */
export function chosen(files) {
    const pairs = [...files].map((file) => [file.webkitRelativePath || file.name, file]);
    return pairs.some(([path]) => path.includes("/")) ? [pairs] : pairs.map((pair) => [pair]);
}

async function inEntry(entry, before) {
    const path = before + entry.name;
    if (entry.isFile) {
        return [[path, await new Promise((give, fail) => entry.file(give, fail))]];
    }
    const reader = entry.createReader();
    const found = [];
    // A reader gives a hundred at a time.
    for (;;) {
        const some = await new Promise((give, fail) => reader.readEntries(give, fail));
        if (some.length === 0) {
            return found;
        }
        found.push(...(await Promise.all(some.map((inner) => inEntry(inner, `${path}/`)))).flat());
    }
}

/** The recordings among the files: what lies at the top, each a file or a folder. */
export function recordings(files) {
    return [...new Set(files.map(([path]) => path.split("/")[0]))];
}

/** The files of each recording. */
export function apart(files) {
    return recordings(files).map((name) => files.filter(([path]) => path.split("/")[0] === name));
}

/** What is said of files that are too large together; an empty text where they are not. */
export function tooLarge(files) {
    const bytes = files.reduce((sum, [, file]) => sum + file.size, 0);
    if (bytes <= LARGEST) {
        return "";
    }
    const size = `${(bytes / 1e6).toFixed(0)} MB`;
    const names = recordings(files).join(", ");
    return (
        `${names}: ${size}, and this page reads ${LARGEST / 1e6} MB at most. The program reads larger files: ` +
        `install it and run the command below. Or cut the recording: ten minutes at 100 Hz are enough.`
    );
}

/** The folder that files are put in which are the sensors of one recording. */
const TOGETHER = "recording";

/** The files in one folder, where each has one sensor and all of them together have both; else as they are. */
export function joined(files, documents) {
    const sensors = documents.map((document) => (document.sensors ?? []).map(({ sensor }) => sensor));
    const motion = sensors.flat().filter((name) => name === "accelerometer" || name === "gyroscope");
    const isApart = files.every(([path]) => !path.includes("/")) && files.length > 1;
    const isOne = sensors.every((all) => all.length <= 1) && motion.toSorted().join() === "accelerometer,gyroscope";
    return isApart && isOne ? files.map(([path, file]) => [`${TOGETHER}/${path}`, file]) : files;
}
