// Makes a new scene from one of the service's templates.
import * as api from "./api.js";
import { by_id, element } from "./dom.js";
import { default_of } from "./schema.js";

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
        by_id("template-choice").addEventListener("change", (event) => this.choose(event.target.value));
    }

    async offer() {
        if (this.templates) return;
        this.templates = await api.list_templates();
        by_id("template-choice").append(...this.templates.map(({ name, title }) => element("option", { value: name, title }, name.replaceAll("_", " "))));
        by_id("templates-row").hidden = this.templates.length === 0;
    }

    /// Of options that several templates share, by name.
    entries(...names) {
        const all = (this.templates ?? []).flatMap(({ options }) => options);
        return Object.fromEntries(names.map((name) => all.find((each) => each.name === name)).filter(Boolean).map((each) => [each.name, entry_of(each)]));
    }

    choose(name) {
        const template = this.templates.find((each) => each.name === name);
        if (!template) return this.panel.close();
        const named = { type: "string", description: "of scene and study: small letters, digits, - and _", default: name };
        this.panel.open({
            title: `${template.title}.`,
            properties: { name: named, ...Object.fromEntries(template.options.map((each) => [each.name, entry_of(each)])) },
            follow: (values, control_of) => follow(template.options, values, control_of),
            make: async (values, signal) => ({ study: (await api.make_from_template(name, values, signal)).study }),
        });
        by_id("template-choice").value = name;
    }

    /// Whether the shown template has an earthquake; null: not an option, or no template is shown.
    is_shaken() {
        const { source, options } = this.panel;
        return source?.properties.with_fem ? options.values.with_fem ?? false : null;
    }
    make(is_shaken) {
        if (this.is_shaken() !== null) this.panel.options.set(["with_fem"], is_shaken);
        else if (this.panel.source) this.panel.make();
    }
}
