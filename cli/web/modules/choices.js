// What a person may choose before a recording is calibrated, as options of the command line.
import { element } from "./elements.js";
import { pairs } from "./options.js";
import { quoted, split } from "./shell_words.js";

const PLACE = [
    ["--latitude", "Latitude, degrees", "such as 47.4"],
    ["--altitude", "Height above the sea, m", "such as 400"],
    ["--gravity", "Or gravity itself, m/s²", "such as 9.8066"],
];
const READ = [
    ["--accel-unit", "Unit of the accelerometer", ["m/s^2", "g", "mg", "cm/s^2", "counts"]],
    ["--gyro-unit", "Unit of the gyroscope", ["rad/s", "deg/s", "mdeg/s", "counts"]],
    ["--mag-unit", "Unit of the magnetometer", ["uT", "nT", "mT", "T", "G", "mG", "counts"]],
    ["--rate", "Sampling rate, Hz", "such as 100"],
];
/** Options that say how a calibration is made, not how a recording is read. */
const NOT_READING = new Set(["--latitude", "--altitude", "--gravity", "--sensor", "--method", "--effects", "--clock"]);

/** The form of choices. */
export class Choices {
    constructor(form, changed) {
        this.fields = new Map();
        this.more = form.querySelector("#more-options");
        const place = form.querySelector("#place");
        const after = form.querySelector("#read > label");
        PLACE.forEach((choice) => place.append(this.field(...choice)));
        READ.forEach((choice) => after.before(this.field(...choice)));
        form.addEventListener("input", changed);
    }

    field(option, label, values) {
        const id = `option${option}`;
        const isNumber = typeof values === "string";
        const made = isNumber
            ? element("input", { id, type: "text", inputMode: "decimal", placeholder: values, autocomplete: "off" })
            : element("select", { id }, element("option", { value: "" }, "as found"), values.map((value) => element("option", { value }, value)));
        this.fields.set(option, made);
        return element("label", { htmlFor: id }, `${label} `, made);
    }

    /** Adds a line of options; those that are there already are replaced. */
    add(line) {
        for (const [option, ...value] of pairs(split(line))) {
            const field = this.fields.get(option);
            if (field) {
                field.value = value.join(" ");
                continue;
            }
            const others = pairs(split(this.more.value)).filter(([name]) => name !== option);
            this.more.value = [...others, [option, ...value]].map((pair) => pair.map(quoted).join(" ")).join(" ");
        }
    }

    /** Brings a person to where a line is completed. */
    complete(line) {
        const [option] = split(line);
        const field = this.fields.get(option);
        if (!field) {
            this.add(line);
        }
        const target = field ?? this.more;
        target.closest("details")?.setAttribute("open", "");
        target.focus();
    }

    /** Whether a line says how a recording is read, and not how it is calibrated. */
    isReading(line) {
        return !NOT_READING.has(split(line)[0]);
    }

    /** Whether a line of options is given already. */
    has(line) {
        const given = this.pairs().map((pair) => pair.join(" "));
        return pairs(split(line)).every((pair) => given.includes(pair.join(" ")));
    }

    clear() {
        [...this.fields.values(), this.more].forEach((field) => {
            field.value = "";
        });
    }

    /** All options, as pairs of an option and its value. */
    pairs() {
        const given = [...this.fields].map(([option, field]) => [option, field.value.trim().replace(",", ".")]);
        return [...given.filter(([, value]) => value !== ""), ...pairs(split(this.more.value))];
    }

    /** The words of all options. */
    words() {
        return this.pairs().flatMap(joined);
    }

    /** The words of options that say how a recording is read. */
    reading() {
        return this.pairs().filter(([option]) => !NOT_READING.has(option)).flatMap(joined);
    }
}

/** A value that begins like an option has to stand behind the sign of equality. */
function joined([option, ...values]) {
    return values.length === 1 && values[0].startsWith("-") ? [`${option}=${values[0]}`] : [option, ...values];
}
