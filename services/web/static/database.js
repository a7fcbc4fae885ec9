// The run database as tables: runs, tasks, attempts, events, results of sweeps, firings of triggers, transfers of all runs, and workers.
// Reads the API page by page. The address #/database/TABLE/RUN selects the table and the run.
import * as api from "./api.js";
import { by_id, element, set_text } from "./dom.js";
import { counts_text, flag_codes, rest_text } from "./flags.js";
import { short_json, show_state } from "./format.js";
import { offer_runs } from "./run_picker.js";
import { run_address } from "./runs.js";
import { DataTable } from "./table.js";

const page_size = 500;      // records per request
const batches_at_once = 4;  // loaded before the user requests more

const badge = (record) => {
    const made = element("span");
    show_state(made, record.state);
    return made;
};
const open_run = ({ run, id }) => element("a", { href: run_address(run ?? id) }, run ?? id);

const text = (name, title = name.replaceAll("_", " "), more = {}) => ({ name, title, ...more });
const amount = (name, unit = "", title) => text(name, title, { number: true, unit });
const moment = (name) => text(name, name, { unit: "UTC", cell: (record) => (record[name] ?? "–").replace("T", " ").replace("Z", "") });
const state = text("state", "state", { cell: badge });
const run = text("run", "run", { cell: open_run });

const columns = {
    runs: [text("id", "id", { cell: open_run }), text("name"), text("title", "title", { wide: true }), state, moment("created"),
           moment("started"), moment("finished"), amount("tasks_total"), amount("tasks_done"), amount("tasks_failed"),
           amount("questionable"), text("flags", "flags", { wide: true }), text("message", "message", { wide: true })],
    tasks: [text("label"), text("phase"), text("variant"), amount("transfer_time", "s", "t_T"), state, text("ended"), text("flags", "flags", { wide: true }), moment("started"),
            moment("finished"), amount("attempts"), amount("cpu_seconds", "s", "CPU"), amount("wall_seconds", "s", "wall"),
            amount("files"), amount("bytes"), text("fault", "fault", { wide: true }),
            text("same_as", "taken from"), text("id"), run],
    attempts: [text("label"), amount("number"), text("phase"), text("variant"), amount("transfer_time", "s", "t_T"), state,
               moment("started"), moment("finished"), amount("exit_code"), amount("signal"), amount("wall_seconds", "s", "wall"),
               amount("cpu_seconds", "s", "CPU"), text("task"), run],
    events: [amount("seq"), moment("time"), text("kind"), text("detail", "detail", { wide: true }), text("task"), run],
    results: [amount("transfer_time", "s", "t_T"), text("variant"), state, amount("runout", "m"), amount("runout_error", "m", "error"),
              amount("runout_beyond_toe", "m", "passed the toe"), amount("runout_largest", "m", "farthest"), amount("volume_ratio"),
              amount("numerical_share"), amount("overlap"), text("rest"), amount("kinetic_share"), amount("end_time", "s", "end"),
              text("flags", "flags", { wide: true }), amount("cpu_seconds", "s", "CPU"), text("trigger"), text("reused"),
              text("runout_error_from", "error from", { wide: true }), amount("factor_of_safety"), amount("factor_of_safety_liquefied"), text("reason", "reason", { wide: true }), run],
    triggers: [text("name"), text("kind"), state, amount("transfer_time", "s", "t_T"),
               amount("wanted_time", "s"), amount("lag_s", "s", "lag"), amount("fem_step"), amount("fired_ms", "ms", "fired after"),
               amount("start_ms", "ms", "started after"), text("crossed", "crossed", { wide: true, cell: ({ crossed }) => (crossed ? short_json(crossed) : "–") }), text("snapshot"),
               text("sha256", "SHA-256"), text("fem_task"), run],
    transfers: [amount("transfer_time", "s", "t_T"), text("variant"), state, text("why"), text("condition", "condition", { wide: true }),
                amount("wanted_time", "s"), amount("fem_step"), amount("snapshot_ms", "ms", "snapshot after"),
                amount("start_ms", "ms", "started after"), moment("started"), amount("runouts"), text("same_as", "taken from"),
                text("fault", "fault", { wide: true }), text("task"), run],
    workers: [text("phase"), text("label"), text("variant"), state, amount("progress"), text("message", "message", { wide: true }), moment("since"),
              text("host"), text("pid"), text("job"), text("job_state", "job state"), text("job_reason", "job reason", { wide: true }),
              amount("cores"), amount("cpu_seconds", "s", "CPU"), amount("memory_used_MB", "MB", "memory used"),
              amount("memory_MB", "MB", "memory asked"), amount("attempt"), text("task"), run],
};
const of_one_run = ["tasks", "attempts", "results", "triggers"];

const sum = (list, name) => list.reduce((total, each) => total + (each[name] ?? 0), 0);

/// Flags of a result; "": no result, or not reported.
const codes_of = ({ flags }) => (flags ? flag_codes(flags) : "");

const readers = {
    tasks: (whole) => whole.tasks.map((task) => ({ ...task, attempts: task.attempts.length, cpu_seconds: sum(task.attempts, "cpu_seconds"),
        wall_seconds: sum(task.attempts, "wall_seconds"), flags: codes_of(task), files: task.artifacts.length, bytes: sum(task.artifacts, "bytes"),
        fault: task.fault?.summary ?? "" })),
    attempts: (whole) => whole.tasks.flatMap(({ id, label, phase, variant, transfer_time, attempts }) =>
        attempts.map((attempt) => ({ run: whole.id, task: id, label, phase, variant, transfer_time, ...attempt }))),
    results: async ({ id }) => (await api.read_results(id)).rows.map((row) => ({ run: id, ...row, rest: row.runout === null ? "" : rest_text(row),
        flags: codes_of(row) })),
    triggers: async ({ id }) => (await api.read_triggers(id)).flatMap((trigger) =>
        (trigger.firings.length ? trigger.firings : [{}]).map((firing) => ({ run: id, ...trigger, ...firing, lag_s: Number(firing.lag_s?.toFixed(9) ?? NaN) }))),
};

/// Tables over all runs, one page at a time: {records, place of the next page, whether it was the last}.
const pages = {
    runs: async (place) => {
        const { runs, next } = await api.page_of_runs(place, page_size);
        return { records: runs.map((each) => ({ ...each, flags: counts_text(each.flag_counts) })), next, last: !next };
    },
    transfers: async (place) => {
        const { transfers, next } = await api.page_of_transfers(place, page_size);
        return { records: transfers, next, last: !next };
    },
    events: async (place) => {
        const { events, next } = await api.page_of_events(place ?? 0);
        return { records: events, next, last: events.length === 0 };
    },
};

const counts_in = (object) => Object.entries(object).map(([word, count]) => `${count} ${word}`).join(", ");

/// Occupied resources of the machine or cluster, and the queue.
function slots_text({ executor, slots, slots_used, memory_MB, memory_asked_MB, limits, queue, slurm }) {
    const parts = [`${executor === "slurm" ? "Slurm" : "Local"}: ${slots_used} of ${slots} cores taken`,
                   memory_MB ? `${memory_asked_MB} of ${memory_MB} MB asked for` : "", `${queue.ready} tasks ready`,
                   queue.retry_wait ? `${queue.retry_wait} wait to be tried again` : "", `${queue.blocked} wait for others`];
    if (Object.keys(limits).length > 0) parts.push(`at most ${counts_in(limits)} at once`);
    if (slurm) parts.push(`jobs: ${counts_in(slurm.states) || "none"}`, counts_in(slurm.reasons));
    return `${parts.filter(Boolean).join("; ")}.`;
}

export class Database {
    constructor() {
        this.table = new DataTable(by_id("database-table"));
        by_id("database-run").addEventListener("change", (event) => {
            location.hash = `#/database/${this.name}/${event.target.value}`;
        });
        by_id("database-more").addEventListener("click", () => this.load());
        by_id("database-again").addEventListener("click", () => this.show(this.name, this.run));
    }

    /// name: table; run: "" for the newest.
    async show(name, run) {
        this.name = name in columns ? name : "runs";
        this.run = run;
        Object.assign(this, { records: [], place: null, finished: false });
        for (const link of by_id("database-tabs").querySelectorAll("a")) {
            const mine = link.dataset.table === this.name;
            link.href = `#/database/${link.dataset.table}${run ? `/${encodeURIComponent(run)}` : ""}`;
            if (mine) link.setAttribute("aria-current", "page");
            else link.removeAttribute("aria-current");
        }
        by_id("database-of").hidden = !of_one_run.includes(this.name);
        by_id("database-slots").hidden = this.name !== "workers";
        await this.load();
    }

    async load() {
        const [name, run] = [this.name, this.run];
        set_text(by_id("database-message"), "Reading…");
        try {
            if (of_one_run.includes(name)) await this.load_of_run(name, run);
            else if (name === "workers") await this.look_at_workers();
            else await this.load_pages(name);
            if (this.name === name && this.run === run) set_text(by_id("database-message"), "");
        } catch (fault) {
            set_text(by_id("database-message"), fault.message);
        }
    }

    async load_of_run(name, wanted) {
        const { runs } = await api.page_of_runs(null, page_size);
        const id = wanted || (runs[0]?.id ?? "");
        offer_runs(by_id("database-run"), runs, id);
        const link = by_id("database-csv");
        link.hidden = name !== "results" || !id;
        if (!link.hidden) link.href = api.results_csv(id);
        const records = id ? await readers[name](await api.read_run(id)) : [];
        if (this.name === name && this.run === wanted) this.fill(records, true);
    }

    /// Called again whenever the workers may have changed.
    async look_at_workers() {
        if (this.name !== "workers") return;
        by_id("database-csv").hidden = true;
        const answer = await api.read_workers();
        if (this.name !== "workers") return;
        set_text(by_id("database-slots"), slots_text(answer));
        this.fill(answer.workers, true);
    }

    /// Runs and transfers newest first, events oldest first, up to the end or a limit.
    async load_pages(name) {
        by_id("database-csv").hidden = true;
        const records = [...this.records];
        let { place, finished } = this;
        for (let batch = 0; batch < batches_at_once && !finished; batch += 1) {
            const page = await pages[name](place);
            records.push(...page.records);
            [place, finished] = [page.next, page.last];
        }
        if (this.name !== name) return;
        this.place = place;
        this.fill(records, finished);
    }

    fill(records, finished) {
        Object.assign(this, { records, finished });
        by_id("database-more").hidden = finished;
        this.table.open(this.name, columns[this.name], records, !finished);
    }
}
