// The steps of a new run, and the entries of a study and its scene in each step.
import { by_id, element, set_text } from "./dom.js";

const steps = [
    { name: "section", title: "Section", help: "Take a template, an example or your own file; a file can be dropped anywhere here." },
    { name: "soils", title: "Soils", help: "Density, strength and stiffness of each soil. Amber: outside the plausible range. A preset brings its published source along." },
    { name: "water", title: "Water and earthquake", help: "The phreatic line of each computation, and the motion of an earthquake." },
    { name: "question", title: "Question", help: "What is to be known. The settings of each computation stand below." },
    { name: "check", title: "Check", help: "Name the run, look at the drawing and the warnings, submit." },
];

/// Entries below a place belong to its step; all others to the question.
const places = {
    "/scene/name": "section", "/scene/title": "section", "/scene/notes": "section", "/scene/section": "section", "/scene/thickness": "section", "/scene/gravity": "section",
    "/scene/materials": "soils",
    "/scene/lem/water": "water", "/scene/lem/piezometric_lines": "water", "/scene/lem/pore_pressure_ratios": "water", "/scene/lem/seismic_coefficient": "water",
    "/scene/fem/water": "water", "/scene/fem/motion": "water", "/scene/fem/base": "water", "/scene/transfer/phreatic_line": "water",
    "/name": "check", "/title": "check", "/report": "check", "/resources": "check", "/priority": "check",
};
const titles = { "/scene/section": "Every entry of the section", "/scene/materials": "Every entry of the soils", "/scene/lem": "Stability (LEM)",
                 "/scene/fem": "Shaking and pore pressure (FEM)", "/scene/transfer": "Transfer from FEM to MPM", "/scene/mpm": "Runout (MPM)" };
const is_below = (pointer, place) => pointer === place || pointer.startsWith(`${place}/`);

/// Title of a group; undefined: its own name.
export const title_of = (pointer) => titles[pointer];
export const step_of = (pointer) => Object.entries(places).find(([place]) => is_below(pointer, place))?.[1] ?? "question";
/// The steps that show a part of an entry: its own, and those of places below it.
export const steps_of = (pointer) => [...new Set([step_of(pointer), ...Object.entries(places).filter(([place]) => is_below(place, pointer)).map(([, step]) => step)])];

export class Path {
    /// entered(step): called when another step is shown.
    constructor(entered) {
        Object.assign(this, { entered, pane: by_id("path") });
        this.buttons = new Map(steps.map(({ name, title }, i) => [name, element("button", { type: "button", onclick: () => this.show(name) },
            element("span", { class: "step-number" }, String(i + 1)), ` ${title} `, element("span", { class: "fault-count", hidden: true }))]));
        by_id("steps").append(...[...this.buttons.values()].map((button) => element("li", {}, button)));
        for (const [id, by] of [["step-back", -1], ["step-next", 1]]) by_id(id).addEventListener("click", () => this.go(by));
        this.show("section");
    }
    at() { return steps.findIndex(({ name }) => name === this.step); }
    go(by) {
        this.show(steps[this.at() + by].name);
        by_id("step-title").focus();
    }

    show(name) {
        this.step = this.pane.dataset.step = name;
        const at = this.at();
        for (const button of this.buttons.values()) button.removeAttribute("aria-current");
        this.buttons.get(name).setAttribute("aria-current", "step");
        set_text(by_id("step-title"), `${at + 1}. ${steps[at].title}`);
        set_text(by_id("step-help"), steps[at].help);
        by_id("step-back").hidden = at === 0;
        const next = steps[at + 1];
        by_id("step-next").hidden = !next;
        by_id("step-next").replaceChildren("Next", element("span", { class: "wide" }, `: ${next?.title}`));
        by_id("submit").classList.toggle("primary", !next);
        this.pane.scrollTop = 0;
        this.entered(name);
    }

    /// faults: {pointer, is_warning}
    count(faults) {
        for (const [name, button] of this.buttons) {
            const own = faults.filter(({ pointer }) => step_of(pointer) === name);
            const badge = button.lastElementChild;
            badge.hidden = own.length === 0;
            const is_calm = own.every(({ is_warning }) => is_warning);
            badge.classList.toggle("warn", is_calm);
            set_text(badge, String(own.length));
            badge.title = is_calm ? "warnings" : "faults and warnings";
        }
    }
}
