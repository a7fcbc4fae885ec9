// Replaces the scene's section by a drawing (DXF, CSV). Soils are those in the text, or one for each layer.
import * as api from "./api.js";
import { number } from "./format.js";

const units = ["m", "mm", "cm", "dm", "km", "in", "ft", "yd", "mi", "us-ft"];
const properties = {
    map: { type: "string", description: "what layers stand for, with ; between: DAM=embankment; WATER=phreatic; TEXT=none. Without it: the soil or line of the layer's own name" },
    layers: { type: "string", description: "regions cut by depth below the phreatic line [m], with ; between: tailings=5,10,15" },
    unit: { type: "string", enum: units, description: "of the drawing; not set: what the drawing says, metres for CSV" },
    tolerance: { type: "number", unit: "m", exclusiveMinimum: 0, maximum: 10, default: 0.05, description: "what is nearer is meant to touch" },
    with_fem: { topic: "water", type: "boolean", default: false, description: "yes: shaken by a synthetic earthquake (PM4Sand, FEM, transfer, runout); the layers can liquefy" },
    liquefied: { topic: "question", type: "string", description: "what liquefies at rest below the phreatic line, with its residual strength and source, with ; between: tailings=0.08, CPTu 2024 (share of sigma'_v0) or tailings=4kPa, CPTu 2024" },
    flatten: { type: "number", unit: "m", exclusiveMinimum: 0, maximum: 10, description: "arcs become chords that are off by at most this; not set: arcs are faults" },
};
const pieces = (text) => (text ?? "").split(";").map((each) => each.trim()).filter(Boolean);

const unit_sources = { asked: "as asked", drawing: "the drawing's $INSUNITS", header: "the table's header", default: "metres, as nothing says otherwise" };

/// What the service read, healed and guessed, in one line.
function note_of({ unit, unit_from, size, healed = [], guessed = [], remarks = [] }) {
    const largest = Math.max(...healed.map(({ size: off }) => off));
    return [size ? `read in ${unit} (${unit_sources[unit_from]}): the section is ${number(size[0])} m long and ${number(size[1])} m high` : "",
            healed.length ? `${healed.length} places healed, the largest ${number(largest, 3)} m` : "nothing had to be healed",
            guessed.length ? `guessed: ${guessed.map(({ pointer, value }) => `${pointer} ${JSON.stringify(value)}`).join(", ")}` : "", ...remarks].filter(Boolean).join("; ");
}

const stand_in = { density: 1900, law: { type: "mohr_coulomb", E_MPa: 20, nu: 0.3, c_kPa: 1, phi_deg: 30 } };
const is_whole = ({ density, law, strength }) => density > 0 && (law?.type !== "mohr_coulomb" || (law.E_MPa > 0 && law.nu >= 0 && (strength || (law.c_kPa >= 0 && law.phi_deg >= 0))));

/// Soils before an earthquake was added, where NAME_runout becomes NAME again, or before they liquefied.
function at_rest(soils) {
    const shaken = Object.keys(soils).filter((name) => soils[`${name}_runout`]);
    const added = shaken.length ? ["liquefied", ...shaken.map((name) => `${name}_runout`)] : [];
    const is_made = ({ notes = [] }) => notes.some((note) => /limit_strength is drained, before it liquefies$|\(1 - r_u\)/.test(note));
    return Object.fromEntries(Object.entries(soils).filter(([name, soil]) => !added.includes(name) && !is_made(soil)).map(([name, soil]) => [name, soils[`${name}_runout`] ?? soil]));
}

/// Placeholders would become soil with wrong values.
function need_values(soils, option) {
    const missing = Object.keys(soils).filter((name) => !is_whole(soils[name]));
    if (missing.length)
        throw Object.assign(new Error("soils without values"), { faults: [{ pointer: `/${option}`, cause: `needs whole soils; values are missing of ${missing.join(", ")}`, remedy: "fill them in at the step Soils" }] });
}

export class SectionImport {
    /// panel: an OptionsPanel; templates: the Templates; drawing: the LiveDrawing, which shows the file's faults; wants_soils(): called when
    /// layers became soils without values.
    constructor(panel, templates, drawing, wants_soils) {
        Object.assign(this, { panel, templates, drawing, wants_soils });
    }

    begin(file, drawing) {
        const study = this.panel.study();
        const is_again = this.panel.source?.is_import;
        const soils = ({ with_fem }) => {
            const own = this.panel.study()?.scene?.materials ?? {};
            return with_fem ? own : at_rest(own);
        };
        // The service places the search of the stability analysis, which needs complete soils: placeholders replace those without values.
        const asked = ({ map, layers, liquefied, ...others }, own) => ({ drawing, file, map: pieces(map), layers: pieces(layers), liquefied: pieces(liquefied), ...others,
            materials: Object.fromEntries(Object.entries(own).map(([name, soil]) => [name, is_whole(soil) ? soil : stand_in])) });
        this.panel.open({
            title: `Section of ${file}.`, properties: { ...properties, ...this.templates.entries("pga", "shaking") }, is_import: true, base: is_again ? this.panel.made : { scene: { section: study?.scene?.section } },
            make: async (values, signal) => {
                let own = soils(values);
                const fails = values.liquefied ? "liquefied" : values.with_fem ? "with_fem" : null;
                if (fails) need_values(own, fails);
                const is_empty = Object.keys(own).length === 0;
                const found = await api.import_section(asked(values, is_empty ? { "no soil yet": stand_in } : own), signal).catch((fault) => {
                    const layers = (fault.faults ?? []).map(({ cause }) => cause.match(/^layer (.+) has no material/)?.[1]).filter(Boolean);
                    if (!is_empty || layers.length === 0) throw fault;
                    own = Object.fromEntries(layers.map((layer) => [layer, { law: { type: "mohr_coulomb" } }]));
                    return api.import_section(asked(values, own), signal);
                });
                if (is_empty) this.wants_soils();
                const note = `${note_of(found.report)}${study?.scene?.section && !is_again ? "; it takes the place of the section that stood there" : ""}`;
                const scene = fails ? found.scene : { ...found.scene, materials: own };
                return { study: { format: "breachline-study/1", name: scene.name, ...found.study, scene }, note };
            },
            failed: (fault) => this.show_faults(asked(this.panel.options.values, soils(this.panel.options.values)), fault),
        });
    }

    /// Shows the service's picture of the file with every fault at its place.
    async show_faults(body, fault) {
        const picture = await api.picture_of_import(body).catch(() => null);
        this.drawing.show_foreign(picture, fault);
    }
}
