// Options that a message offers.
import { quoted } from "./shell_words.js";

/** Devices and numbers that a message lists, as in "`0` (3474 rows), `1` (3474 rows); say which, as in --instance 0". */
const LISTED = /`([^`]+)` \(\d+ rows\)/g;
/** Sensors that a message lists, as in "IMU 0 (45 samples, 45 Hz)". */
const NUMBERED = /(\d+) \(\d+ samples/g;
/** An option with its value, as in "--accel-unit g" and "--columns 'gx=gx*0.9366'". */
const OPTION = /(--[a-z][a-z-]+)(?:[ =]('[^']*'|[^\s;,:()']+))?/g;
/** Options that concern how a recording is read or where it was made: what the page can ask for. */
const READING = new Set([
    "--accel-unit", "--altitude", "--columns", "--entry", "--flip", "--format", "--gravity", "--gyro-unit",
    "--instance", "--latitude", "--mag-unit", "--na", "--part", "--rate", "--sensor", "--skip-bad-rows", "--sort-time",
    "--time-format", "--time-unit", "--topic",
]);
/** Options that stand alone. */
const ALONE = new Set(["--sort-time"]);

/** The options that a message offers: lines, and whether a person has to complete each. */
export function offered(message) {
    const found = new Map();
    for (const match of message.matchAll(OPTION)) {
        const [, option, value] = match;
        const isAgain = !value && [...found.keys()].some((line) => line.startsWith(option));
        if (!READING.has(option) || isAgain) {
            continue;
        }
        const listed = option === "--instance" ? instances(message) : [];
        listed.forEach((name) => found.set(`${option} ${quoted(name)}`, false));
        if (ALONE.has(option)) {
            found.set(option, false);
        } else if (listed.length === 0) {
            // A value that is an example is not the answer.
            const isExample = message.slice(0, match.index).endsWith("as in ");
            const isOpen = !value || value.includes("…") || (isExample && option !== "--topic");
            found.set(`${option} ${value ?? "…"}`, isOpen);
        }
    }
    return [...found].map(([line, isOpen]) => ({ line, isOpen }));
}

function instances(message) {
    const found = [...message.matchAll(LISTED), ...message.matchAll(NUMBERED)];
    return [...new Set(found.map(([, name]) => name))];
}
