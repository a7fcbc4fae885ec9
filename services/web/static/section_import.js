// A section that was drawn elsewhere (DXF, CSV) in place of the scene's: the soils are those that stand in the text.
import * as api from "./api.js";
import { by_id } from "./dom.js";
import { number } from "./format.js";
import { print } from "./json_text.js";

const units = ["m", "mm", "cm", "dm", "km", "in", "ft", "yd", "mi", "us-ft"];
const properties = {
    map: { type: "string", description: "what layers stand for, with ; between: DAM=embankment; WATER=phreatic; TEXT=none. Without it: the soil or line of the layer's own name" },
    layers: { type: "string", description: "regions cut by depth below the phreatic line [m], with ; between: tailings=5,10,15" },
    unit: { type: "string", enum: units, description: "of the drawing; not set: what the drawing says, metres for CSV" },
    tolerance: { type: "number", unit: "m", exclusiveMinimum: 0, maximum: 10, default: 0.05, description: "what is nearer is meant to touch" },
    flatten: { type: "number", unit: "m", exclusiveMinimum: 0, maximum: 10, description: "arcs become chords that are off by at most this; not set: arcs are faults" },
};
const pieces = (text) => (text ?? "").split(";").map((each) => each.trim()).filter(Boolean);

const unit_sources = { asked: "as asked", drawing: "the drawing's $INSUNITS", default: "metres, as nothing says otherwise" };

/// What the service took, healed and took upon itself, as one line.
function note_of({ unit, unit_from, size, healed = [], guessed = [], remarks = [] }) {
    const largest = Math.max(...healed.map(({ size: off }) => off));
    return [size ? `read in ${unit} (${unit_sources[unit_from]}): the section is ${number(size[0])} m long and ${number(size[1])} m high` : "",
            healed.length ? `${healed.length} places healed, the largest ${number(largest, 3)} m` : "nothing had to be healed",
            guessed.length ? `guessed: ${guessed.map(({ pointer, value }) => `${pointer} ${JSON.stringify(value)}`).join(", ")}` : "", ...remarks].filter(Boolean).join("; ");
}

export class SectionImport {
    /// panel: an OptionsPanel; pane: the text; drawing: the LiveDrawing, which shows what is wrong with the file.
    constructor(panel, pane, drawing) {
        Object.assign(this, { panel, pane, drawing });
        by_id("section-file").addEventListener("change", (event) => this.take(event.target));
    }

    async take(input) {
        const file = input.files[0];
        if (!file) return;
        const drawing = await file.text();
        input.value = "";
        this.begin(file.name, drawing);
    }

    begin(file, drawing) {
        const study = this.study_so_far();
        const asked = ({ map, layers, ...others }) => ({ drawing, file, materials: study.scene?.materials ?? {}, map: pieces(map), layers: pieces(layers), ...others });
        this.panel.open({
            title: `Section of ${file}: it takes the place of the scene's, with the soils that stand there.`, properties,
            make: async (values, signal) => {
                const { scene: { format, name, section, ...others }, report } = await api.import_section(asked(values), signal);
                const { title, materials } = study.scene ?? {};
                const scene = { format, name, ...(title === undefined ? {} : { title }), materials, section, ...others, ...(materials ? { materials } : {}) };
                return { text: print({ ...study, scene }), note: note_of(report) };
            },
            failed: (fault) => this.show_faults(asked(this.panel.options.values), fault),
        });
    }
    study_so_far() {
        try {
            const document = JSON.parse(this.pane.text);
            return document.section ? { format: "breachline-study/1", name: document.name ?? "section", scene: document } : document;
        } catch {
            return { format: "breachline-study/1", name: "section" };
        }
    }

    /// The service's picture of the file has every fault at its place.
    async show_faults(body, fault) {
        const picture = await api.picture_of_import(body).catch(() => null);
        this.drawing.show_foreign(picture, fault);
    }
}
