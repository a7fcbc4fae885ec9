// Makes a new scene from one of the service's templates.
import * as api from "./api.js";
import { by_id } from "./dom.js";
import { default_of } from "./schema.js";
import { study_card } from "./study_cards.js";

const entry_of = ({ topic, type, unit, default: usual, minimum, maximum, help, rule }) => ({ topic, type, unit, default: usual, minimum, maximum, description: rule ? `${help} (default: ${rule})` : help });

/// Shows defaults that are a share of another option.
function follow(options, values, control_of) {
    for (const { name, follows, share, minimum, maximum, unit } of options.filter((each) => each.follows)) {
        const other = values[follows] ?? options.find((each) => each.name === follows)?.default;
        control_of(name).placeholder = default_of({ default: Number(Math.min(maximum, Math.max(minimum, share * other)).toPrecision(4)), unit });
    }
}

export class Templates {
    /// panel: an OptionsPanel.
    constructor(panel) {
        this.panel = panel;
    }

    async offer() {
        if (this.templates) return;
        this.templates = await api.list_templates();
        by_id("template-choice").append(...this.templates.map((each) => study_card(each, () => this.study(each.name), () => this.choose(each.name))));
    }

    /// Of options that several templates share, by name.
    entries(...names) {
        const all = (this.templates ?? []).flatMap(({ options }) => options);
        return Object.fromEntries(names.map((name) => all.find((each) => each.name === name)).filter(Boolean).map((each) => [each.name, entry_of(each)]));
    }

    async study(name, values = {}, signal = undefined) {
        return (await api.make_from_template(name, values, signal)).study;
    }

    /// "": none is chosen.
    mark(name) {
        for (const card of by_id("template-choice").children) card.setAttribute("aria-pressed", String(card.value === name));
    }

    choose(name) {
        const template = this.templates.find((each) => each.name === name);
        const named = { type: "string", description: "of scene and study: small letters, digits, - and _", default: name };
        this.panel.open({
            title: `${template.title}.`,
            properties: { name: named, ...Object.fromEntries(template.options.map((each) => [each.name, entry_of(each)])) },
            follow: (values, control_of) => follow(template.options, values, control_of),
            make: async (values, signal) => ({ study: await this.study(name, values, signal) }),
        });
        this.mark(name);
    }

    /// Whether the shown template has an earthquake; null: not an option, or no template is shown.
    is_shaken() {
        const { source, options } = this.panel;
        return source?.properties.with_fem ? options.values.with_fem ?? false : null;
    }
    /// Whether the shown options ask for residual strengths.
    can_liquefy() { return Boolean(this.panel.source?.properties.liquefied); }
    /// wants_strengths: begins the entry of residual strengths, which the service refuses until it is filled in.
    make(is_shaken, wants_strengths) {
        if (this.can_liquefy()) {
            const { values } = this.panel.options;
            if (is_shaken) delete values.liquefied;
            else if (wants_strengths) values.liquefied ??= "REGION=STRENGTH, SOURCE";
        }
        if (this.is_shaken() !== null) this.panel.options.set(["with_fem"], is_shaken);
        else if (this.panel.source) this.panel.make();
    }
}
