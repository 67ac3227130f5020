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

/** The options that a message offers, each as a line; a line with `…` or without a value is to be completed. */
export function offered(message) {
    const lines = [];
    for (const [, option, value] of message.matchAll(OPTION)) {
        const complete = ALONE.has(option) ? option : `${option} ${value ?? "…"}`;
        if (!READING.has(option) || lines.some((line) => line.startsWith(`${option} `) && !value)) {
            continue;
        }
        const listed = option === "--instance" ? instances(message) : [];
        lines.push(...(listed.length > 0 ? listed.map((name) => `${option} ${quoted(name)}`) : [complete]));
    }
    return [...new Set(lines)];
}

/** Whether something is left to a person in the line. */
export function isOpen(line) {
    return line.includes("…");
}

function instances(message) {
    const found = [...message.matchAll(LISTED), ...message.matchAll(NUMBERED)];
    return [...new Set(found.map(([, name]) => name))];
}
