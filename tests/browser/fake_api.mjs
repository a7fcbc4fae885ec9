// A stand-in for the orchestrator: the same REST shapes over real HTTP, with made-up runs that advance by the clock.
// Only for tests of the page; the soil here is a formula, not mechanics.
import { createHash } from "node:crypto";
import { readFile } from "node:fs/promises";
import { createServer } from "node:http";
import { fileURLToPath } from "node:url";
import path from "node:path";

const static_folder = fileURLToPath(new URL("../../services/web/static", import.meta.url));
const content_types = { ".html": "text/html", ".js": "text/javascript", ".css": "text/css", ".svg": "image/svg+xml" };

const scene = {
    format: "breachline-scene/1", name: "column",
    section: { regions: [{ name: "column", polygon: [[0, 0], [10, 0], [10, 20], [0, 20], [0, 0]] }] },
    mpm: { runout: { toe: [10, 0] } },
};
export const study = { format: "breachline-study/1", name: "fake-column", title: "A column made of formulas", scene,
                       transfer_times: [0.25, 0.5, 0.75, 1, 1.25, 1.5, 1.75, 2] };

const digest = (text) => createHash("sha256").update(text).digest("hex");
const clamp = (value) => Math.min(1, Math.max(0, value));

/// One run: FEM for a while, each transfer soon after its time, then two MPM runs side by side.
class FakeRun {
    /// pace: seconds that the whole run takes; points: particles per snapshot.
    constructor(id, submitted, { pace, points, began = Date.now() }) {
        Object.assign(this, { id, study: submitted, pace, points, began, cancelled_at: null });
        const times = submitted.transfer_times;
        const [fem_end, mpm_time] = [0.4 * pace, (0.6 * pace * 2) / times.length];
        this.tasks = [{ phase: "lem_tool", from: 0, to: 0.1 * pace }, { phase: "fem_solver", from: 0, to: fem_end }];
        times.forEach((transfer_time, i) => {
            const taken = ((i + 1) / times.length) * fem_end;
            const begin = Math.max(taken, fem_end + Math.floor(i / 2) * mpm_time);
            const broken = transfer_time === 1.25;
            this.tasks.push({ phase: "transfer_tool", transfer_time, from: taken, to: taken + 0.02 * pace, fails: broken });
            this.tasks.push({ phase: "mpm_solver", transfer_time, from: begin, to: begin + mpm_time, skipped: broken });
        });
        this.tasks.forEach((task, i) => Object.assign(task, { id: `${id}-task-${i}` }));
    }

    age() {
        return ((this.cancelled_at ?? Date.now()) - this.began) / 1000;
    }

    progress_of(task) {
        return clamp((this.age() - task.from) / (task.to - task.from));
    }

    state_of(task) {
        const progress = this.progress_of(task);
        if (task.skipped && this.age() > task.from) return "skipped";
        if (progress >= 1) return task.fails ? "failed" : "succeeded";
        if (this.cancelled_at) return "cancelled";
        return progress > 0 ? "running" : "blocked";
    }

    describe_task(task) {
        const state = this.state_of(task);
        const at = (age) => new Date(this.began + 1000 * age).toISOString();
        const started = !["blocked", "skipped"].includes(state) && this.age() > task.from;
        const ended = !["blocked", "running"].includes(state);
        return {
            id: task.id, run: this.id, phase: task.phase, label: task.phase, transfer_time: task.transfer_time ?? null,
            state, progress: this.progress_of(task), message: state === "running" ? "step 120, dt 1.2 ms" : "",
            result: state === "succeeded" && task.phase === "mpm_solver" ? this.runout(task.transfer_time) : null,
            fault: state === "failed" ? { exit_code: 70, summary: "mass differs by 3e-9, 1e-12 is allowed" } : null,
            attempts: started ? [{ number: 1, state: ended ? "exited" : "running", started: at(task.from),
                                   finished: ended ? at(task.to) : null, exit_code: ended ? (task.fails ? 70 : 0) : null,
                                   wall_seconds: ended ? task.to - task.from : null, cpu_seconds: ended ? 1.5 : null }] : [],
            artifacts: state === "succeeded" ? [{ name: "result.json", sha256: digest(task.id), bytes: 2345 }] : [],
        };
    }

    runout(transfer_time) {
        const reach = 11 + 6 * Math.exp(-((transfer_time - 1) ** 2)) - 1.5 * transfer_time;
        return { runout: reach, runout_beyond_toe: reach + 1.2, runout_largest: reach + 2.5,
                 volume_ratio: 1.01, numerical_share: 0.031, cpu_seconds: 7.25 };
    }

    summary() {
        const states = this.tasks.map((task) => this.state_of(task));
        const count = (...wanted) => states.filter((state) => wanted.includes(state)).length;
        const over = count("blocked", "running") === 0;
        const state = !over ? "running" : this.cancelled_at ? "cancelled" : count("failed") ? "partial" : "succeeded";
        return { id: this.id, name: this.study.name, title: this.study.title, state,
                 created: new Date(this.began).toISOString(), started: new Date(this.began).toISOString(),
                 finished: over ? new Date(Math.min(Date.now(), this.began + 1000 * this.pace)).toISOString() : null,
                 progress: clamp(this.age() / this.pace), tasks_total: states.length, tasks_done: count("succeeded"),
                 tasks_failed: count("failed"), message: "" };
    }

    rows() {
        const find = (phase, time) => this.tasks.find((task) => task.phase === phase && task.transfer_time === time);
        return this.study.transfer_times.map((transfer_time) => {
            const [transfer, mpm] = [find("transfer_tool", transfer_time), find("mpm_solver", transfer_time)];
            const failed = this.state_of(transfer) === "failed";
            const state = failed ? "failed" : this.state_of(mpm);
            const numbers = state === "succeeded" ? this.runout(transfer_time) : {};
            return { transfer_time, state, transfer_task: transfer.id, mpm_task: mpm.id,
                     ...Object.fromEntries(Object.keys(this.runout(1)).map((key) => [key, numbers[key] ?? null])) };
        });
    }

    telemetry(phase) {
        const task = this.tasks.find((candidate) => candidate.phase === phase);
        const lines = [];
        const count = Math.floor(401 * this.progress_of(task));
        for (let i = 0; i < count; i += 1) {
            const time = i * 0.005;
            const slip = Math.max(0, time - 0.3);
            lines.push({ time, crest_dx: 0.8 * slip ** 2, crest_dy: -1.1 * slip ** 2,
                         kinetic_energy: 4e5 * slip ** 2 * Math.exp(-slip), jacobian_ratio_avg: 1 - 0.12 * slip,
                         epsilon_q_avg: 0.03 + 0.2 * slip ** 1.5, newton_iterations: 3 + (i % 4) });
        }
        return lines;
    }

    frames(task) {
        const count = Math.floor(24 * this.progress_of(task)) + (this.progress_of(task) > 0 ? 1 : 0);
        const kind = task.phase === "fem_solver" ? "mesh" : "particles";
        return Array.from({ length: count }, (_, i) => ({ time: i * 0.5, name: `snapshot_${String(i).padStart(5, "0")}`,
                                                          sha256: digest(`${task.id}${i}`), kind }));
    }

    /// The bytes of one snapshot: a column that spreads out.
    points_of(task, index, stride) {
        const is_mesh = task.phase === "fem_solver";
        const rows = is_mesh ? 41 : Math.round(Math.sqrt(2 * this.points));
        const columns = is_mesh ? 21 : Math.round(this.points / rows);
        const spread = 1 - Math.exp(-index / (is_mesh ? 30 : 6));
        const values = { x: [], y: [], speed: [], epsilon_q: [], region: [] };
        for (let j = 0; j < rows; j += 1) {
            for (let i = 0; i < columns; i += 1) {
                if (!is_mesh && (j * columns + i) % stride !== 0) continue;
                const [u, v] = is_mesh ? [i / (columns - 1), j / (rows - 1)] : [(i + 0.5) / columns, (j + 0.5) / rows];
                const reach = 10 * (1 + 1.6 * spread * (1 - v) ** 1.5 * u);
                values.x.push(u * reach);
                values.y.push(20 * v * (1 - 0.6 * spread * (0.4 + 0.6 * u)));
                values.speed.push(6 * spread * (1 - spread) * 4 * u * (1 - v));
                values.epsilon_q.push(1.4 * spread * Math.exp(-(((v - 0.9 * (1 - u)) / 0.25) ** 2)));
                values.region.push(v < 0.25 ? 0 : 1);
            }
        }
        const quads = [];
        for (let j = 0; is_mesh && j < rows - 1; j += 1) {
            for (let i = 0; i < columns - 1; i += 1) {
                const n = j * columns + i;
                quads.push(n, n + 1, n + columns + 1, n + columns);
            }
        }
        const header = { time: index * 0.5, count: values.x.length, fields: Object.keys(values), regions: ["base", "column"],
                         ...(is_mesh ? { quads: quads.length / 4 } : {}) };
        let line = JSON.stringify(header);
        line += " ".repeat((4 - ((line.length + 1) % 4)) % 4) + "\n";
        return Buffer.concat([Buffer.from(line), ...Object.values(values).map((list) => Buffer.from(Float32Array.from(list).buffer)),
                              Buffer.from(Uint32Array.from(quads).buffer)]);
    }
}

export class FakeApi {
    /// pace: seconds per submitted run; points: particles per snapshot.
    constructor({ pace = 6, points = 5000 } = {}) {
        Object.assign(this, { pace, points, runs: [], events: [], requests: [] });
    }

    add_run(submitted, settings = {}) {
        const run = new FakeRun(`run-${this.runs.length + 1}`, submitted, { pace: this.pace, points: this.points, ...settings });
        this.runs.push(run);
        this.tell(run.id, "created");
        return run;
    }

    tell(run, kind) {
        this.events.push({ seq: this.events.length + 1, time: new Date().toISOString(), run, task: null, kind, detail: {} });
    }

    async open(port = 0) {
        this.server = createServer((request, response) => this.answer(request, response).catch((fault) => {
            console.error(fault);
            problem(response, 500, String(fault));
        }));
        await new Promise((resume) => this.server.listen(port, "127.0.0.1", resume));
        return `http://127.0.0.1:${this.server.address().port}`;
    }

    async close() {
        this.server.closeAllConnections();
        await new Promise((resume) => this.server.close(resume));
    }

    async answer(request, response) {
        const url = new URL(request.url, "http://localhost");
        this.requests.push(`${request.method} ${url.pathname}`);
        const parts = url.pathname.split("/").filter(Boolean);
        if (parts[0] !== "v1") return this.serve_file(response, url.pathname);
        const [, kind, id, ...rest] = parts;
        if (kind === "events") return this.serve_events(url, response);
        if (kind === "examples") {
            return json(response, id ? study : { examples: [{ name: study.name, title: study.title }] });
        }
        if (kind === "scenes") return json(response, { plans: { fem_solver: "on        softening    /materials" } });
        if (kind === "tasks") return this.serve_task(id, rest, url, response);
        if (kind === "runs" && !id) {
            if (request.method === "POST") return this.submit(request, response);
            return json(response, { runs: this.runs.map((run) => run.summary()).reverse() });
        }
        const run = this.runs.find((candidate) => candidate.id === id);
        if (kind !== "runs" || !run) return problem(response, 404, "there is no such thing");
        if (rest[0] === "cancel") {
            run.cancelled_at ??= Date.now();
            this.tell(run.id, "cancelled");
            return json(response, run.summary(), 202);
        }
        if (rest[0] === "results") return json(response, { run: run.id, rows: run.rows() });
        if (rest[0] === "telemetry") {
            const from = Number(url.searchParams.get("from") ?? 0);
            const lines = run.telemetry(url.searchParams.get("phase")).slice(from, from + 150);
            return json(response, { lines, next: from + lines.length });
        }
        return json(response, { ...run.summary(), study: run.study, tasks: run.tasks.map((task) => run.describe_task(task)) });
    }

    async submit(request, response) {
        let text = "";
        for await (const chunk of request) text += chunk;
        let body;
        try {
            body = JSON.parse(text);
        } catch (fault) {
            return problem(response, 400, `the body is not JSON: ${fault.message}`);
        }
        const faults = [];
        if (!Array.isArray(body.transfer_times)) {
            faults.push({ pointer: "/transfer_times", cause: "is missing", remedy: "give a list of times in seconds" });
        }
        for (const [name, material] of Object.entries(body.scene?.materials ?? {})) {
            if (!(material.density < 0)) continue;
            faults.push({ pointer: `/scene/materials/${name}/density`, cause: `${material.density} kg/m3 is below 0`,
                          remedy: "a soil weighs 1,200 to 2,400 kg/m3" });
        }
        if (faults.length) return problem(response, 422, "the study has faults", faults);
        return json(response, this.add_run(body).summary(), 202);
    }

    async serve_events(url, response) {
        const after = Number(url.searchParams.get("after"));
        const until = Date.now() + 1000 * Number(url.searchParams.get("wait"));
        while (this.events.length <= after && Date.now() < until && !response.destroyed) {
            await new Promise((resume) => setTimeout(resume, 50));
        }
        json(response, { events: this.events.slice(after), next: this.events.length });
    }

    serve_task(id, rest, url, response) {
        const run = this.runs.find((candidate) => candidate.tasks.some((task) => task.id === id));
        const task = run?.tasks.find((candidate) => candidate.id === id);
        if (!task) return problem(response, 404, "there is no such task");
        if (rest[0] === "attempts") {
            const lines = Math.floor(60 * run.progress_of(task));
            const text = Array.from({ length: lines }, (_, i) => `[info] ${task.phase} step ${i}\n`).join("");
            const offset = Number(url.searchParams.get("offset") ?? 0);
            response.writeHead(200, { "Content-Type": "text/plain; charset=utf-8", "X-Next-Offset": text.length });
            return response.end(text.slice(offset));
        }
        if (rest[0] !== "frames") return json(response, run.describe_task(task));
        if (rest.length === 1) return json(response, { frames: run.frames(task) });
        const bytes = run.points_of(task, Number(rest[1].slice(-5)), Number(url.searchParams.get("stride") ?? 1));
        response.writeHead(200, { "Content-Type": "application/octet-stream" });
        return response.end(bytes);
    }

    async serve_file(response, name) {
        const file = path.join(static_folder, name === "/" ? "index.html" : name.replace(/^\/static\//, ""));
        if (!file.startsWith(static_folder)) return problem(response, 404, "outside");
        const body = await readFile(file).catch(() => null);
        if (!body) return problem(response, 404, "there is no such file");
        response.writeHead(200, { "Content-Type": content_types[path.extname(file)] ?? "application/octet-stream" });
        return response.end(body);
    }
}

function json(response, body, status = 200) {
    response.writeHead(status, { "Content-Type": "application/json" });
    response.end(JSON.stringify(body));
}

function problem(response, status, detail, faults = []) {
    response.writeHead(status, { "Content-Type": "application/problem+json" });
    response.end(JSON.stringify({ type: "/problems/bad-input", title: "Bad input", status, detail, faults }));
}
