// Records an animation as WebM in the browser, from pictures drawn on a canvas.
import { file_word, offer_file } from "./download.js";
import { draw_sheet } from "./sheet.js";

export const pictures_per_second = 12;
const last_stays = 1500; // [ms]
const bits_per_second = 8e6;

const rest = (length) => new Promise((resume) => setTimeout(resume, length));

/// count: number of pictures; show(i): shows the i-th; sheet(): its sheet; told(i): called when it is recorded; stopped(): the user
/// cancelled. Returns the film as a Blob. Throws when the browser cannot record.
export async function film_of({ count, show, sheet, told, stopped }) {
    if (!window.MediaRecorder) throw new Error("this browser cannot record films");
    const kind = ["video/webm;codecs=vp9", "video/webm;codecs=vp8", "video/webm"].find((each) => MediaRecorder.isTypeSupported(each));
    if (!kind) throw new Error("this browser cannot record WebM");
    const canvas = document.createElement("canvas");
    // Fetches every snapshot before the recording, so that no wait slows the film; sizes the canvas for the tallest sheet.
    for (let i = 0; i < count && !stopped(); i += 1) {
        await show(i);
        if (i === 0 || i === count - 1) draw_sheet(canvas, sheet(), 1);
    }
    const stream = canvas.captureStream(0);
    const [track] = stream.getVideoTracks();
    const recorder = new MediaRecorder(stream, { mimeType: kind, videoBitsPerSecond: bits_per_second });
    const parts = [];
    recorder.addEventListener("dataavailable", (event) => parts.push(event.data));
    const ended = new Promise((resume) => recorder.addEventListener("stop", resume, { once: true }));
    recorder.start();
    for (let i = 0; i < count && !stopped(); i += 1) {
        const began = performance.now();
        await show(i);
        draw_sheet(canvas, sheet(), 1);
        track.requestFrame();
        told(i);
        await rest(Math.max(0, 1000 / pictures_per_second - (performance.now() - began)));
    }
    await rest(last_stays);
    draw_sheet(canvas, sheet(), 1); // otherwise the last picture has no duration
    track.requestFrame();
    await rest(100);
    recorder.stop();
    await ended;
    track.stop();
    return new Blob(parts, { type: "video/webm" });
}

/// The relation of film time and snapshot time, in words.
export function pace_text(times) {
    const steps = times.slice(1).map((time, i) => time - times[i]);
    const mean = steps.reduce((sum, step) => sum + step, 0) / Math.max(steps.length, 1);
    if (steps.length === 0) return "";
    const even = steps.every((step) => Math.abs(step - mean) < 0.02 * mean);
    return even ? `Film: 1 s is ${Number((mean * pictures_per_second).toPrecision(3))} s of motion.`
        : `Film: ${pictures_per_second} snapshots per second, which are not evenly apart in time.`;
}

export const offer_film = (name, blob) => offer_file(`${file_word(name)}.webm`, blob);
