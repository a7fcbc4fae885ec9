// Studies to begin with, as buttons with a picture: the section of the study's own scene, one sentence, the minutes that it takes.
import * as api from "./api.js";
import { element, set_text } from "./dom.js";
import { number } from "./format.js";
import { overlay_of, scene_of, water_of } from "./scene.js";
import { SectionPicture } from "./section_picture.js";

let estimate = Promise.resolve(); // one at a time: what a person does meanwhile comes first

/// entry: {name, title}; read(): resolves to the study; choose(): called by a click.
export function study_card({ name, title }, read, choose) {
    const picture = element("div");
    const minutes = element("span", { class: "muted" }, "loading…");
    fill(name, new SectionPicture(picture), minutes, read).catch((fault) => set_text(minutes, fault.message));
    return element("button", { type: "button", class: "study-card", value: name, onclick: choose }, picture, element("span", {}, title), minutes);
}

async function fill(name, picture, minutes, read) {
    const study = await read();
    const scene = scene_of(study);
    picture.show({ ...overlay_of(scene), water: water_of(scene), gauges: [], slip: [], says: `section of ${name}` });
    const { wall_seconds: [low, high] } = await (estimate = estimate.catch(() => {}).then(() => api.cost_of(JSON.stringify(study))));
    set_text(minutes, high < 60 ? "less than a minute" : `${number(low / 60, 1)} to ${number(high / 60, 1)} minutes`);
}
