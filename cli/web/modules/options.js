// Options in a line of words.

/** Options without a value. */
const ALONE = new Set(["--sort-time"]);

/** Whether an option stands without a value. */
export function isAlone(option) {
    return ALONE.has(option);
}

/** The words as pairs of an option and its value. */
export function pairs(words) {
    const found = [];
    for (const word of words) {
        const [option, value] = word.startsWith("--") && word.includes("=") ? [word.slice(0, word.indexOf("=")), word.slice(word.indexOf("=") + 1)] : [word];
        const last = found.at(-1);
        if (word.startsWith("--") || !last || last.length > 1 || isAlone(last[0])) {
            found.push(value === undefined ? [option] : [option, value]);
        } else {
            last.push(word);
        }
    }
    return found;
}
