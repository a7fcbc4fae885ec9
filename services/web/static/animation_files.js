// Buttons that save an animation: the picture as PNG and SVG, all pictures as a film; in the page's PREFIX-files.
import { by_id, element, set_text } from "./dom.js";
import { offer_canvas, offer_svg } from "./figure_files.js";
import { film_of, offer_film } from "./film.js";
import { draw_sheet, sheet_as_svg } from "./sheet.js";

export class AnimationFiles {
    /// sheet(film): the shown picture as a sheet, or null; film: for a film. count(), show(i): the pictures. at(): index of the shown one.
    /// name(): of the files, without extension.
    constructor(prefix, animation) {
        Object.assign(this, { prefix, animation, recording: false });
        const button = (name, text, onclick) => element("button", { type: "button", id: `${prefix}-${name}`, onclick }, text);
        by_id(`${prefix}-files`).append(
            button("png", "PNG", () => this.save((sheet) => {
                const canvas = document.createElement("canvas");
                draw_sheet(canvas, sheet);
                offer_canvas(animation.name(), canvas);
            })),
            button("svg", "SVG", () => this.save((sheet) => offer_svg(animation.name(), sheet_as_svg(sheet)))),
            button("film", "Film (WebM)", () => (this.recording ? this.stop() : this.record())),
            element("span", { id: `${prefix}-file-note`, class: "muted", role: "status" }));
    }

    part(name) {
        return by_id(`${this.prefix}-${name}`);
    }

    save(offer) {
        const sheet = this.animation.sheet(false);
        if (sheet) offer(sheet);
    }

    stop() {
        this.recording = false;
    }

    async record() {
        const { animation } = this;
        const [count, before] = [animation.count(), animation.at()];
        if (count < 2 || !animation.sheet(true)) return;
        this.recording = true;
        set_text(this.part("film"), "Stop the film");
        set_text(this.part("file-note"), "Fetching the pictures…");
        try {
            const blob = await film_of({
                count, show: (i) => animation.show(i), sheet: () => animation.sheet(true), stopped: () => !this.recording,
                told: (i) => set_text(this.part("file-note"), `Recording picture ${i + 1} of ${count}`),
            });
            set_text(this.part("file-note"), this.recording ? "" : "Stopped: nothing was saved.");
            if (this.recording) offer_film(animation.name(), blob);
        } catch (fault) {
            set_text(this.part("file-note"), `No film: ${fault.message}`);
        }
        this.recording = false;
        set_text(this.part("film"), "Film (WebM)");
        await animation.show(before);
    }
}
