// What is in a file.
import { element, table } from "./elements.js";

const SENSORS = ["sensor", "unit", "rows", "for s", "rate Hz", "gaps"];
const TOPIC = /--topic (\S+)/;
const STREAMS = ["sensor", "source", "rows", "rate Hz", "option"];

/** What `info` found in a file. */
export function infoView(document) {
    // A zip archive is read as the folder that it holds, which is none of a person's concern.
    const format = document.format === "folder" ? "" : (document.format ?? document.schema ?? "");
    const parts = [element("h3", {}, document.file, element("span", { className: "soft" }, ` ${format}`))];
    if (document.sensors) {
        parts.push(table(SENSORS, document.sensors.map(sensorRow)));
    }
    if (document.streams) {
        parts.push(table(STREAMS, document.streams.map(streamRow)));
    }
    const rests = document.static_intervals;
    if (rests) {
        parts.push(element("p", {}, `Static intervals: ${rests.count}, ${rests.seconds.toFixed(1)} s in all.`));
    }
    parts.push(notes("Notes", document.warnings ?? []));
    return element("section", { className: "info" }, ...parts);
}

/** Remarks, folded where there are many. */
export function notes(title, texts) {
    if (texts.length === 0) {
        return null;
    }
    const list = element("ul", {}, texts.map((text) => element("li", {}, text)));
    const summary = element("summary", {}, `${title} (${texts.length})`);
    return element("details", { open: texts.length <= 3, className: "notes" }, summary, list);
}

/** The options that a log of several sensors asks about: for each accelerometer its own, with the gyroscope of the same number. */
export function optionsOf(streams) {
    const of = (name) => streams.filter(({ sensor, option }) => sensor === name && option);
    const [accelerometers, gyroscopes] = [of("accelerometer"), of("gyroscope")];
    const first = accelerometers.length > 0 ? accelerometers : gyroscopes;
    const options = first.map((stream) => {
        const isBeside = ({ instance, option }) => instance === stream.instance && option !== stream.option;
        const isOne = gyroscopes.some(({ option }) => option === stream.option);
        const topic = isOne ? undefined : gyroscopes.find(isBeside)?.option.match(TOPIC)?.[1];
        return topic ? stream.option.replace(TOPIC, `--topic $1,${topic}`) : stream.option;
    });
    return [...new Set(options)];
}

function sensorRow(sensor) {
    const { rate, duration, gaps, longest_gap: longest } = sensor;
    const holes = gaps ? `${gaps}, to ${longest.toFixed(2)} s` : "none";
    return [sensor.sensor, sensor.unit, sensor.samples, fixed(duration), fixed(rate), holes];
}

function streamRow({ sensor, source, samples, rate, option, instance }) {
    return [sensor, `${source} ${instance ?? ""}`, samples, fixed(rate), option ?? ""];
}

function fixed(value) {
    return typeof value === "number" ? value.toFixed(2) : "";
}
