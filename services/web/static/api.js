// The orchestrator's REST API as functions.

/// The server refused the request: application/problem+json (RFC 9457), with one entry in `faults` per place.
export class Problem extends Error {
    constructor(status, body) {
        super(body.detail || body.title || `the server answered ${status}`);
        this.status = status;
        this.title = body.title ?? "";
        this.faults = body.faults ?? [];
    }
}

/// The server did not answer at all.
export class Unreachable extends Error {}

let token = null;
let ask_for_token = null;

/// Sets the bearer token of every request (null: none), and the function that gets another when the server refuses it: ask(refused token or
/// null) resolves to it.
export function authorise(known, ask) {
    token = known;
    ask_for_token = ask;
}

async function request(path, options = {}) {
    const sent = token;
    const headers = sent ? { ...options.headers, Authorization: `Bearer ${sent}` } : options.headers;
    let response;
    try {
        response = await fetch(path, { cache: "no-cache", ...options, headers });
    } catch (fault) {
        if (fault.name === "AbortError") throw fault;
        throw new Unreachable("the server does not answer");
    }
    if (response.ok) return response;
    if (response.status === 401 && ask_for_token) {
        // Another request may have got a new token meanwhile.
        if (token === sent) token = await ask_for_token(sent);
        return request(path, options);
    }
    const body = await response.json().catch(() => ({}));
    throw new Problem(response.status, body);
}

/// The connection may break while the body arrives.
async function body_of(response, kind) {
    try {
        return await response[kind]();
    } catch (fault) {
        if (fault.name === "AbortError" || fault instanceof SyntaxError) throw fault;
        throw new Unreachable("the server went away in the middle of an answer");
    }
}

const get_json = async (path, options) => body_of(await request(path, options), "json");

const json_body = (text) => ({ method: "POST", headers: { "Content-Type": "application/json" }, body: text });
const post_json = (path, text) => get_json(path, json_body(text));

const path_of = (...parts) => "/v1/" + parts.map(encodeURIComponent).join("/");

export const list_runs = async () => (await get_json("/v1/runs")).runs;
/// {runs, next}: the newest with this text in their name, title or id; next: null when these are all.
export const find_runs = (search) => get_json(`/v1/runs${search ? `?${new URLSearchParams({ search })}` : ""}`);
/// Disk use by run; slow, as the server reads every file's size.
export const read_storage = () => get_json("/v1/storage");
export const rename_run = (run, title) => post_json(path_of("runs", run, "title"), JSON.stringify({ title }));
/// {runs, next}; cursor: `next` of the previous page.
export function page_of_runs(cursor, limit) {
    const query = new URLSearchParams({ limit });
    if (cursor) query.set("cursor", cursor);
    return get_json(`/v1/runs?${query}`);
}
/// {transfers, next} of all runs, newest first; cursor: `next` of the previous page.
export function page_of_transfers(cursor, limit) {
    const query = new URLSearchParams({ limit });
    if (cursor) query.set("cursor", cursor);
    return get_json(`/v1/transfers?${query}`);
}
/// Map of a run's transfer tasks to their FEM tasks; empty: the service does not report it.
export async function fems_of_transfers(run) {
    const fems = new Map();
    let cursor = null;
    try {
        do {
            const query = new URLSearchParams({ limit: 500 });
            if (cursor) query.set("cursor", cursor);
            const { transfers, next } = await get_json(`${path_of("runs", run, "transfers")}?${query}`);
            for (const { task, fem_task: fem } of transfers) fems.set(task, fem);
            cursor = next;
        } while (cursor);
    } catch (fault) {
        if (!(fault instanceof Problem) || fault.status !== 404) throw fault;
    }
    return fems;
}
/// Running tasks and workers: {executor, slots, slots_used, queue, workers, slurm, ...}
export const read_workers = () => get_json("/v1/workers");
/// {events, next} after this number.
export const page_of_events = (after) => get_json(`/v1/events?after=${after}&wait=0`);
export const read_run = (run) => get_json(path_of("runs", run));
/// The same without its tasks.
export const read_run_alone = (run) => get_json(`${path_of("runs", run)}?tasks=0`);
export const report_of = (run) => path_of("runs", run, "report");
export const submit_study = (text) => post_json("/v1/runs", text);
export const remove_run = (run) => get_json(path_of("runs", run), { method: "DELETE" });
/// order: cancel, pause, resume or retry
export const command_run = (run, order) => post_json(path_of("runs", run, order), "{}");
export const read_task = (task) => get_json(path_of("tasks", task));
export const read_triggers = async (run) => (await get_json(path_of("runs", run, "triggers"))).triggers;
/// A stored file: JSON, or text.
export const read_json_artifact = (sha256) => get_json(artifact_path(sha256), { cache: "default" });
export const read_text_artifact = async (sha256) => body_of(await request(artifact_path(sha256), { cache: "default" }), "text");
export const read_results = (run) => get_json(path_of("runs", run, "results"));
export const results_csv = (run, means) => path_of("runs", run, "results") + (means ? "?format=csv&table=means" : "?format=csv");
/// Percentiles, importance, samples of a study over distributions.
export const read_uncertainty = (run) => get_json(path_of("runs", run, "uncertainty"));
export const uncertainty_file = (run, format) => `${path_of("runs", run, "uncertainty")}?format=${format}`;
/// Findings of a study of several motions; null: not such a study.
export async function read_motions(run) {
    try {
        return await get_json(path_of("runs", run, "motions"));
    } catch (fault) {
        if (fault instanceof Problem && fault.status === 404) return null;
        throw fault;
    }
}
/// Envelopes of the samples along x; null: none.
export async function read_envelopes(run) {
    try {
        return await get_json(path_of("runs", run, "envelopes"));
    } catch (fault) {
        if (fault instanceof Problem && [404, 409].includes(fault.status)) return null;
        throw fault;
    }
}
/// A file of the server as a Blob.
export const read_file = async (path) => body_of(await request(path), "blob");
export const artifact_path = (sha256) => path_of("artifacts", sha256);
/// The section of a study or a scene as SVG text.
export async function draw_document(text, with_mesh, signal) {
    return body_of(await request(`/v1/draw${with_mesh ? "?mesh=1" : ""}`, { ...json_body(text), signal }), "text");
}
/// The expected cost of a study: {lines, ...}.
export const cost_of = (text, signal) => get_json("/v1/cost", { ...json_body(text), signal });
/// of: "scene" or "study"
export const read_schema = (of) => get_json(path_of("schema", of), { cache: "default" });
/// Sends a file; {reference, kind, about, name, ...}.
export const send_file = (file) => get_json(`/v1/files?${new URLSearchParams({ name: file.name })}`,
    { method: "POST", headers: { "Content-Type": "application/octet-stream" }, body: file });
/// Uploaded files, newest first.
export const list_files = async () => (await get_json("/v1/files")).files;
/// Templates of scenes: [{name, title, options}]; empty: the service has none.
export async function list_templates() {
    try {
        return (await get_json("/v1/templates")).templates;
    } catch (fault) {
        if (fault instanceof Problem && fault.status === 404) return [];
        throw fault;
    }
}
/// {options, study} from the given options; the others have their defaults.
export const make_from_template = (name, options, signal) => get_json(path_of("templates", name), { ...json_body(JSON.stringify(options)), signal });
/// {scene, report} of a section drawn as DXF or CSV.
export const import_section = (body, signal) => get_json("/v1/import", { ...json_body(JSON.stringify(body)), signal });
/// The same as SVG text, faults in red.
export const picture_of_import = async (body) => body_of(await request("/v1/import?picture=1", json_body(JSON.stringify(body))), "text");
export const plan_scene = async (text) => (await post_json("/v1/scenes/plan", text)).plans;

/// Telemetry lines of a task from line number `from`; {lines, next}. Reads the stored file of an ended task, otherwise asks the server by
/// phase, time and, if the task is not alone there, variant.
export async function read_telemetry(task, alone, from) {
    const stored = task.artifacts.find((file) => file.name === "telemetry.jsonl");
    if (stored && !alone) {
        const lines = (await read_text_artifact(stored.sha256)).split("\n").filter(Boolean).map((line) => JSON.parse(line));
        return { lines: lines.slice(from), next: lines.length };
    }
    const query = new URLSearchParams({ phase: task.phase, from });
    if (Number.isFinite(task.transfer_time)) query.set("transfer_time", task.transfer_time);
    if (!alone) query.set("variant", task.variant);
    return get_json(`${path_of("runs", task.run, "telemetry")}?${query}`);
}

/// Log text from byte `offset`; {text, next}.
export async function read_log(task, attempt, offset) {
    const response = await request(`${path_of("tasks", task, "attempts", attempt, "log")}?offset=${offset}`);
    const text = await body_of(response, "text");
    const next = Number(response.headers.get("X-Next-Offset") ?? offset + new Blob([text]).size);
    return { text, next };
}

export const list_frames = async (task) => (await get_json(path_of("tasks", task, "frames"))).frames;

/// One snapshot as typed arrays (decode_points). stride: every n-th point.
export async function read_points(task, frame, stride, signal) {
    const response = await request(`${path_of("tasks", task, "frames", frame, "points")}?stride=${stride}`,
                                   { signal, cache: "default" });
    return decode_points(await body_of(response, "arrayBuffer"));
}

/// Decodes one JSON line, padded to a multiple of 4 bytes, then `count` float32 per field, then 4 uint32 node indices per quad of a mesh.
/// Returns {time, count, columns: {x, y, ...}, regions, region_materials (undefined: not in the file), quads: Uint32Array|null}; the arrays
/// are views of `buffer`.
export function decode_points(buffer) {
    const all = new Uint8Array(buffer);
    const line_end = all.indexOf(10);
    if (line_end < 0) throw new Error("the snapshot has no header line");
    const header = JSON.parse(new TextDecoder().decode(all.subarray(0, line_end)));
    const needed = line_end + 1 + 4 * header.count * header.fields.length + 16 * (header.quads ?? 0);
    if (all.length < needed) throw new Error(`the snapshot has ${all.length} bytes instead of ${needed}`);
    let offset = line_end + 1;
    const columns = {};
    for (const field of header.fields) {
        columns[field] = new Float32Array(buffer, offset, header.count);
        offset += 4 * header.count;
    }
    const quads = header.quads ? new Uint32Array(buffer, offset, 4 * header.quads) : null;
    return { time: header.time, count: header.count, columns, regions: header.regions ?? [], region_materials: header.materials, quads };
}

/// Example studies of the server: [{name, title}]; empty: none.
export async function list_examples() {
    try {
        return (await get_json("/v1/examples")).examples;
    } catch (fault) {
        if (fault instanceof Problem) return [];
        throw fault;
    }
}
export const read_example = (name) => get_json(path_of("examples", name));

export const read_glossary = () => get_json("static/glossary.json", { cache: "default" });

const longest_wait = 20; // [s] limit of the server for a long poll

/// Follows the server's events permanently. Calls tell.events(list) after events or a reset, tell.lost(seconds_to_retry) when the server does not
/// answer, tell.found() when it answers again.
export async function follow_events(tell) {
    let after = 0;
    let pause = 1;
    let wait = 0; // the first answers are history: no wait
    for (;;) {
        // A page in the background releases its connection.
        if (document.hidden) await new Promise((shown) => document.addEventListener("visibilitychange", shown, { once: true }));
        try {
            const answer = await get_json(`/v1/events?after=${after}&wait=${wait}`);
            tell.found();
            after = answer.next;
            if (answer.events.length > 0 || answer.reset) tell.events(answer.events);
            else wait = longest_wait;
            pause = 1;
        } catch (fault) {
            if (fault instanceof Unreachable) tell.lost(pause);
            else console.warn("events:", fault);
            await new Promise((resume) => setTimeout(resume, 1000 * pause));
            pause = Math.min(2 * pause, 8);
            wait = 0;
            after = 0; // a reinstalled server counts from one
        }
    }
}
