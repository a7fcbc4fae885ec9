// The dialog of a new run: steps from a section to a submitted study, the drawing and, on request, the JSON. Shows every fault of the
// server at its field and its line, and in a list.
import * as api from "./api.js";
import { by_id, element, set_text } from "./dom.js";
import { Form } from "./form.js";
import { JsonPane } from "./json_pane.js";
import { print } from "./json_text.js";
import { LiveDrawing } from "./live_drawing.js";
import { OptionsPanel } from "./options_panel.js";
import { Path, step_of } from "./path.js";
import { Question } from "./question.js";
import { SectionImport } from "./section_import.js";
import { study_card } from "./study_cards.js";
import { Templates } from "./templates.js";

function format_of(text) {
    try {
        return String(JSON.parse(text)?.format);
    } catch {
        return "";
    }
}

export class SubmitDialog {
    /// submitted(run): called when the server accepted it.
    constructor(submitted) {
        this.submitted = submitted;
        this.dialog = by_id("submit-dialog");
        this.pane = new JsonPane((text) => this.changed(text));
        this.path = new Path((step) => this.entered(step));
        this.form = new Form((change, kind) => this.pane.edit(change, kind), (pointer) => this.pane.scroll_to(pointer), (pointer) => this.path.show(step_of(pointer)));
        this.drawing = new LiveDrawing((fault, is_in_text) => this.fault_item(fault, is_in_text), (pointer) => this.point_to(pointer),
                                       (faults) => this.mark("drawing", faults));
        this.options = new OptionsPanel(this.pane, (fault) => this.refuse(fault), () => {
            this.templates.mark("");
            this.drawing.return_to(this.pane.text);
        }, (study) => this.question.shaped(study));
        this.templates = new Templates(this.options);
        this.question = new Question((change) => this.pane.edit((text) => print(change(JSON.parse(text)))), this.templates);
        this.sections = new SectionImport(this.options, this.templates, this.drawing, () => this.path.show("soils"));
        this.dialog.addEventListener("dragover", (event) => event.preventDefault());
        this.dialog.addEventListener("drop", (event) => this.drop(event));
        for (const button of document.querySelectorAll("[data-opens=submit]")) {
            button.addEventListener("click", () => this.open());
        }
        by_id("examples").addEventListener("change", (event) => this.take_example(this.examples.find(({ name }) => name === event.target.value)));
        by_id("study-file").addEventListener("change", (event) => this.choose_files(event.target));
        by_id("json-show").addEventListener("click", () => this.show_json(by_id("json").hidden));
        by_id("submit").addEventListener("click", () => this.submit());
        by_id("show-plan").addEventListener("click", () => this.show_plan());
        by_id("submit-close").addEventListener("click", () => this.dialog.close());
        this.dialog.addEventListener("keydown", (event) => {
            if (event.key === "Enter" && event.ctrlKey) this.submit();
        });
    }

    async open() {
        this.dialog.showModal();
        this.clear();
        this.path.show("section");
        try {
            await this.form.start();
            this.show_text(this.pane.text);
            await (this.offered ??= this.offer());
        } catch (fault) {
            this.offered = null;
            this.refuse(fault);
        }
    }
    async offer() {
        await this.templates.offer();
        const examples = this.examples = await api.list_examples();
        by_id("examples").append(...examples.map(({ name, title }) => element("option", { value: name, title: title || null }, name)));
        by_id("examples-row").hidden = examples.length === 0;
    }

    entered(step) {
        if (step === "check") this.show_cost();
        if (step !== "water") return;
        for (const part of document.querySelectorAll('#form details[data-steps~="water"][data-steps~="question"]:not(.absent)')) part.open = true;
    }
    show_json(is_shown) {
        by_id("json").hidden = !is_shown;
        by_id("json-show").setAttribute("aria-pressed", String(is_shown));
    }

    /// A template and two studies of the tutorials, for the start page.
    async offer_starts() {
        if (by_id("starts").firstElementChild) return;
        const [templates, examples] = await Promise.all([api.list_templates(), api.list_examples()]);
        const card = (each, read, take) => study_card(each, read, () => this.open().then(take));
        by_id("starts").replaceChildren(
            ...templates.filter(({ name }) => name === "upstream_dam").map((each) => card(each, () => this.templates.study(each.name), () => this.templates.choose(each.name))),
            ...examples.filter(({ name }) => ["static-lift", "column-sweep"].includes(name)).map((each) => card(each, () => api.read_example(each.name), () => this.take_example(each))));
    }

    /// Edits a previous study to run it again, without the variants that the service generated.
    async edit({ variants = [], ...study }) {
        await this.open();
        this.take_text(print({ ...study, variants: variants.filter(({ made_by: by }) => !by) }));
    }

    take_text(text) {
        this.clear();
        this.options.close();
        this.pane.take(text);
    }

    changed(text) {
        this.show_text(text);
        this.show_mended();
        this.drawing.changed(text);
        by_id("study").removeAttribute("aria-invalid");
    }
    show_text(text) {
        this.form.show(text);
        this.marked();
        this.question.show(this.form.is_study && text.trim() !== "" ? this.form.value : null);
        by_id("scene-wanted").hidden = !this.wants_scene();
        if (this.wants_scene()) set_text(by_id("scene-wanted"), `The study names its scene: ${this.form.value.scene}. Choose that file as well.`);
        if (this.path.step === "check") this.show_cost();
    }

    /// Marks corrected faults of the refused submission.
    show_mended() {
        const left = new Set(this.form.faults.map(({ pointer, cause }) => pointer + cause));
        const items = [...by_id("fault-list").children];
        for (const item of items) item.classList.toggle("mended", !left.has(item.dataset.fault));
        if (items.length > 0 && items.every((item) => item.matches(".mended"))) by_id("faults").hidden = true;
    }

    mark(source, faults) {
        this.form.take_faults(source, faults);
        this.marked();
    }
    marked() {
        this.pane.mark(this.form.faults);
        this.path.count(this.form.faults);
    }

    async choose_files(input) {
        const files = [...input.files];
        input.value = "";
        await this.take_files(files);
    }
    /// Motions are dropped on their field instead.
    drop(event) {
        event.preventDefault();
        return this.take_files([...event.dataTransfer.files]);
    }

    /// Reads studies, their scenes, or section drawings; a study before its scene.
    async take_files(files) {
        const read = await Promise.all(files.map(async (file) => ({ name: file.name, text: await file.text() })));
        const is_scene = ({ text }) => format_of(text).startsWith("breachline-scene/");
        for (const each of read.sort((one, other) => is_scene(one) - is_scene(other))) {
            if (/\.(dxf|csv)$/i.test(each.name)) await this.sections.begin(each.name, each.text);
            else if (is_scene(each)) this.take_scene(each.text);
            else this.take_study(each.text);
        }
    }
    /// Shows the check for a complete study, else asks for its scene.
    take_study(text) {
        this.take_text(text);
        this.path.show(this.wants_scene() ? "section" : "check");
    }
    take_scene(text) {
        let scene;
        try {
            scene = JSON.parse(text);
        } catch {
            return this.take_text(text); // the form shows the fault
        }
        const study = this.wants_scene() ? this.form.value : { format: "breachline-study/1", name: scene.name };
        return this.take_study(print({ ...study, scene }));
    }
    /// Whether a study file needs its scene.
    wants_scene() {
        const scene = this.form.is_study && this.form.value?.scene;
        return typeof scene === "string" && scene !== "";
    }

    async take_example(example) {
        if (!example) return;
        by_id("examples").value = ""; // allows another choice
        try {
            const study = example.study ?? await api.read_example(example.name);
            this.take_study(print(study));
        } catch (fault) {
            this.refuse(fault);
        }
    }

    /// Shows the cost of the text's study.
    async show_cost() {
        this.asked?.abort();
        this.asked = new AbortController();
        const lines = by_id("cost-lines");
        if (!lines.firstElementChild) lines.append(element("li", { class: "muted" }, "Estimating…"));
        try {
            const cost = await api.cost_of(this.pane.text, this.asked.signal);
            lines.replaceChildren(...cost.lines.map((line) => element("li", {}, line)));
        } catch (fault) {
            if (fault.name !== "AbortError") lines.replaceChildren(element("li", { class: "muted" }, "Known once the faults are corrected."));
        }
    }

    async submit() {
        this.clear();
        by_id("submit").disabled = true;
        try {
            const run = await api.submit_study(by_id("study").value);
            this.dialog.close();
            this.submitted(run);
        } catch (fault) {
            this.refuse(fault);
        } finally {
            by_id("submit").disabled = false;
        }
    }

    async show_plan() {
        this.clear();
        try {
            const scene = JSON.parse(by_id("study").value).scene;
            const plans = await api.plan_scene(JSON.stringify(scene ?? null));
            by_id("plan").replaceChildren(...Object.entries(plans).flatMap(([phase, text]) =>
                [element("h3", {}, phase), this.plan_table(phase, text)]));
            by_id("plan").hidden = false;
            by_id("plan").scrollIntoView({ block: "nearest" });
            by_id("plan").focus({ preventScroll: true });
        } catch (fault) {
            for (const one of fault.faults ?? []) one.pointer = `/scene${one.pointer}`; // only the scene was sent
            this.refuse(fault);
        }
    }

    /// A plan's lines are columns: on or left out, feature, reason, and the deciding place in the scene.
    plan_table(phase, text) {
        const rows = text.split("\n").filter((line) => line.trim() !== "").map((line) => {
            const [state, what = "", why = "", place = ""] = line.trim().split(/\s{2,}/);
            const pointer = (place || why).match(/^\(?(\/[^)\s]*)\)?$/)?.[1];
            return element("tr", { class: state === "on" ? null : "waiting" },
                element("td", {}, element("span", { class: `state ${state === "on" ? "good" : "off"}` }, state === "on" ? "✓ on" : `⊘ ${state}`)),
                element("th", { scope: "row" }, what), element("td", {}, place || !pointer ? why : ""),
                element("td", {}, pointer ? this.link_to(`/scene${pointer}`, pointer) : place));
        });
        return element("table", { "aria-label": `plan of ${phase}` }, element("tbody", {}, ...rows));
    }

    link_to(pointer, text) {
        return element("button", { type: "button", class: "link", title: "Show the place in the study",
                                   onclick: () => this.point_to(pointer) }, element("code", {}, text));
    }

    clear() {
        by_id("faults").hidden = true;
        by_id("plan").hidden = true;
        by_id("fault-list").replaceChildren();
        by_id("study").removeAttribute("aria-invalid");
        this.mark("submission", []);
    }

    refuse(fault) {
        const faults = fault.faults ?? [];
        const count = faults.length === 1 ? "1 fault" : `${faults.length} faults`;
        set_text(by_id("fault-title"), faults.length && !/\d fault/.test(fault.message) ? `${fault.message} (${count})` : fault.message);
        by_id("fault-list").replaceChildren(...faults.map((one) => this.fault_item(one)));
        by_id("faults").hidden = false;
        by_id("study").setAttribute("aria-invalid", "true");
        this.mark("submission", faults);
        if (faults.length) this.pane.scroll_to(faults[0].pointer);
        if (!faults.length || !this.form.reveal(faults[0].pointer, { focus: true })) by_id("fault-title").focus();
    }

    fault_item(one, is_in_text = true) {
        const is_place = is_in_text && (one.pointer === "" || one.pointer.startsWith("/"));
        return element("li", { "data-fault": one.pointer + one.cause },
                       is_place ? this.link_to(one.pointer, one.pointer || "/") : element("code", {}, one.pointer), ` ${one.cause} `,
                       is_place ? element("span", { class: "muted line" }, `line ${this.pane.line_of(one.pointer)}`) : null,
                       one.remedy ? element("span", { class: "remedy" }, one.remedy) : null);
    }

    /// Opens the field of a place; selects it in the text if the text is shown or there is no field.
    point_to(pointer) {
        const is_found = this.form.reveal(pointer, { focus: true });
        if (!is_found) this.show_json(true);
        if (!by_id("json").hidden) this.pane.select(pointer);
    }
}
