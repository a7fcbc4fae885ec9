// The question of a study: inserts and removes the parts of the document that it needs. Removed parts return with their question.
import { by_id, element, set_text } from "./dom.js";

const kinds = [
    { name: "stability", title: "Does it stand?", help: "stability: factor of safety (LEM)", needs: ["lem"], without: "needs a stability part: add it below" },
    { name: "static", title: "How far does it run, liquefied at rest?", help: "static liquefaction: factor of safety, then runout with residual strengths (LEM, MPM)", needs: ["mpm"],
      without: "needs a runout part: begin with a drawing or a template, or add it below" },
    { name: "seismic", title: "Does an earthquake bring it down?", help: "seismic: pore pressure and failure under a motion, then runout (FEM, transfer, MPM)", needs: ["fem", "transfer", "mpm"],
      without: "needs FEM, transfer and runout: begin with a template or a drawing, or add them below" },
];
const kind_of = ({ fem, mpm }) => (fem ? "seismic" : mpm ? "static" : "stability");
const defined = (entries) => Object.fromEntries(Object.entries(entries).filter(([, value]) => value !== undefined));

/// Pointers of the residual strengths of undrained soils, in the runout and the stability analysis.
function residual_strengths({ materials = {}, lem }) {
    const soils = Object.entries(materials).filter(([, { law }]) => law?.phi_deg === 0 && law.c_kPa > 0).map(([name]) => `/materials/${name}/law/c_kPa`);
    return [...soils, ...(lem?.liquefaction ?? []).flatMap((_, i) => ["residual_strength_kPa", "residual_coefficient_kPa"].filter((name) => name in lem.liquefaction[i]).map((name) => `/lem/liquefaction/${i}/${name}`))];
}

export class Question {
    /// edit(change): replaces the study by change(study); template: {is_shaken(): true, false or null (no earthquake), can_liquefy(), make(is_shaken, wants_strengths)}.
    constructor(edit, template) {
        Object.assign(this, { edit, template, parked: null });
        this.rows = kinds.map((kind) => {
            const radio = element("input", { type: "radio", name: "question", onchange: () => this.choose(kind.name) });
            const note = element("span", { class: "muted" });
            by_id("question").append(element("label", {}, radio, element("span", {}, element("strong", {}, `${kind.title} `), note)));
            return { ...kind, radio, note };
        });
        this.uncertain = element("input", { type: "checkbox", onchange: () => this.ask_uncertainty(this.uncertain.checked) });
        by_id("question").append(element("label", {}, this.uncertain, element("span", {}, element("strong", {}, "How certain is that? "),
            element("span", { class: "muted" }, "uncertainty: samples over the residual strengths in place of the variants; choose the distributions below"))));
    }

    show(study) {
        const scene = study?.scene ?? {};
        this.runs_at_rest = [scene, this.parked?.scene].some((each) => each && kind_of(each) === "static");
        by_id("question").hidden = !scene.section;
        for (const { name, needs, help, without, radio, note } of this.rows) {
            const missing = needs.filter((part) => !scene[part] && !this.parked?.scene?.[part]);
            const is_by_template = this.template.is_shaken() !== null && (name === "seismic" || missing.length === 0 || (name === "static" && this.template.can_liquefy()));
            radio.checked = name === kind_of(scene);
            radio.disabled = !radio.checked && !is_by_template && (missing.length > 0 || (name === "static" && Boolean(scene.fem)));
            set_text(note, !radio.disabled ? help : missing.length ? without : "this scene's soils are those of its FEM");
        }
        this.uncertain.checked = Boolean(study?.uncertainty);
    }

    choose(name) {
        if (name === "stability") {
            this.parked = {};
            return this.edit((study) => this.shaped(study));
        }
        const { scene: parts, ...others } = this.parked ?? {}, wants_strengths = name === "static" && !this.runs_at_rest;
        this.parked = null;
        this.edit((study) => ({ ...study, ...defined(others), scene: { ...study.scene, ...defined(parts ?? {}) } }));
        this.template.make(name === "seismic", wants_strengths);
    }

    /// A generated study without the parts that the question does not need; they are kept.
    shaped(study) {
        if (this.parked === null) return study;
        const { transfer_times, triggers, variants, scene: { fem, transfer, mpm, ...scene }, ...others } = study;
        this.parked = { transfer_times, triggers, variants, scene: { fem, transfer, mpm } };
        const left = variants?.map((each) => ({ ...each, ...defined({ overrides: each.overrides?.filter((one) => !/^\/(fem|transfer|mpm)\//.test(one)) }) }));
        return { ...others, scene, ...defined({ variants: left }) };
    }

    ask_uncertainty(is_asked) {
        this.edit(({ uncertainty, variants, ...study }) => {
            if (!is_asked) return { ...study, ...defined({ variants: this.without }) };
            this.without = variants;
            const factor_on = residual_strengths(study.scene);
            const parameters = factor_on.length ? [{ name: "residual strength", factor_on, distribution: { type: "lognormal", median: 1, cov: 0.3 } }] : [];
            return { ...study, uncertainty: { samples: 16, parameters } };
        });
    }
}
