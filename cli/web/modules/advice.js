// Options that a message or a command offers.
import { isAlone, pairs } from "./options.js";
import { quoted, split } from "./shell_words.js";

/** What is offered, and the option with its value as a shell takes it: "the accelerometer's unit (--accel-unit g)", "the columns of the
 * axes, as in --columns t=1,ax=2". */
const OFFER = /([^;:.()]*?),? ?(as in |\bor |\()(--[a-z][a-z-]+)(?: ((?:'[^']*'|\\'|[^\s'()])+))?/g;
/** What a message lists to choose from. */
const LIST = /(?:is meant|told apart by [^:]+): (.+?)(?:; |$)/s;
/** Rows of the recordings that a file holds. */
const PARTS = /recordings in one file, of (\d+(?: and \d+)*) rows/;
/** Options that concern how a recording is read or where it was made: what the page can ask for. */
const READING = new Set([
    "--accel-unit", "--altitude", "--columns", "--entry", "--flip", "--format", "--gravity", "--gyro-unit",
    "--instance", "--latitude", "--mag-unit", "--na", "--part", "--rate", "--sensor", "--skip-bad-rows", "--sort-time",
    "--time-format", "--time-unit", "--topic",
]);

/** The options that a message offers: lines, what each is, and whether a person has to complete it. */
export function offered(message) {
    const found = new Map();
    for (const [, what, before, option, given] of message.matchAll(OFFER)) {
        if (!READING.has(option)) {
            continue;
        }
        const all = listed(option, message);
        all.forEach(([value, name]) => found.set(`${option} ${quoted(value)}`, { what: name === value ? "" : name, isOpen: false }));
        if (all.length === 0) {
            const value = given?.replace(/[,;.:]+$/, "");
            // A value that is an example is not the answer.
            const isOpen = !isAlone(option) && (!value || value.includes("…") || before !== "(");
            const line = isAlone(option) ? option : `${option} ${value ?? "…"}`;
            found.set(line, { what: what.trim().replace(/^.*\b(?:give|or) /s, ""), isOpen });
        }
    }
    return [...found].map(([line, { what, isOpen }]) => ({ line, what, isOpen }));
}

/** The first such option of a command. */
export function inCommand(command) {
    const found = pairs(split(command)).find(([option]) => READING.has(option));
    // A word in capitals stands for what a person has to give.
    return found && { line: found.map(quoted).join(" "), isOpen: /^[A-Z]{2,}$/.test(found[1]) };
}

/** The values that a message lists for an option, each with its name. */
function listed(option, message) {
    if (option === "--part") {
        const rows = message.match(PARTS)?.[1].split(" and ") ?? [];
        return rows.map((count, k) => [String(k + 1), `${count} rows`]);
    }
    const items = message.match(LIST)?.[1].split(/, (?![^(]*\))/) ?? [];
    if (option === "--entry") {
        return items.map((name) => [name, name]);
    }
    const names = items.map((item) => item.match(/^(.+) \(\d+ (?:rows|samples)/)?.[1]).filter(Boolean);
    if (option === "--topic") {
        return names.map((name) => [name.replace(/ \d+$/, ""), ""]);
    }
    return option === "--instance" ? names.map(numbered) : [];
}

/** A device by its number, which stands last, or by the cell of its rows. */
function numbered(name) {
    const cell = name.match(/^`(.*)`$/)?.[1];
    return cell === undefined ? [name.split(" ").at(-1), name] : [cell, cell];
}
