// Documents that the program writes.

/** A document, or undefined where the text is none. */
export function parsed(text) {
    try {
        return JSON.parse(text);
    } catch {
        return undefined;
    }
}

/** Whether a document of this name is a calibration, or findings, which hold one. */
export function isCalibration(schema) {
    return /^stillpoint\.(calibration|findings)\//.test(schema);
}
