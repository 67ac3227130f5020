// Words of a call, as a shell takes them.

/** A word as a shell takes it. */
export function quoted(word) {
    return /^[\p{L}\p{N}/._+=,-]+$/u.test(word) ? word : `'${word.replaceAll("'", "'\\''")}'`;
}

/** The line of a call. */
export function commandLine(words) {
    return ["stillpoint", ...words].map(quoted).join(" ");
}

/** The words of a line, quotes taken off. */
export function split(line) {
    const words = [];
    let word;
    let quote = "";
    let escaped = false;
    for (const c of line) {
        if (escaped) {
            word = (word ?? "") + c;
            escaped = false;
        } else if (c === "\\" && quote !== "'") {
            escaped = true;
        } else if (quote) {
            quote = c === quote ? "" : quote;
            word = (word ?? "") + (quote ? c : "");
        } else if (c === "'" || c === '"') {
            quote = c;
            word ??= "";
        } else if (/\s/.test(c)) {
            words.push(...(word === undefined ? [] : [word]));
            word = undefined;
        } else {
            word = (word ?? "") + c;
        }
    }
    return word === undefined ? words : [...words, word];
}
