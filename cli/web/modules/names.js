// Names under which the program is given the files of a person.

/** Names of the page's results. */
export const RESULTS = ["cal.json", "report.html", "findings.json", "findings.html", "corrected.csv", "evaluation.html"];

/** What was dropped, each thing a list of files, as one list of files. A number stands before a name that is taken or begins as an option does. */
export function named(things, taken = []) {
    const used = new Set(taken);
    return things.filter((files) => files.length > 0).flatMap((files) => {
        const [name] = files[0][0].split("/");
        const free = unused(name, used);
        used.add(free);
        return files.map(([path, file]) => [free + path.slice(name.length), file]);
    });
}

/** What is said of files that have another name here; an empty text where none has. */
export function renamed(files) {
    const others = files.filter(([path, file]) => !path.includes("/") && path !== file.name);
    return others.map(([path, file]) => `${file.name} is called ${path} here, because its own name is in use. Rename it likewise for the command line.`).join(" ");
}

function unused(name, used) {
    let free = name;
    for (let k = 2; used.has(free) || free.startsWith("-"); k += 1) {
        free = `${k}-${name}`;
    }
    return free;
}
