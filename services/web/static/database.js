// The run database as tables: runs, tasks, attempts, events, results of sweeps, firings of triggers. Reads what the API
// gives, page by page; the address says which table and of which run: #/database/TABLE/RUN.
import * as api from "./api.js";
import { by_id, element, mirror, set_text } from "./dom.js";
import { counts_text, flag_codes, rest_text } from "./flags.js";
import { short_json, show_state } from "./format.js";
import { run_address } from "./runs.js";
import { DataTable } from "./table.js";

const page_size = 500;      // records asked for at a time
const batches_at_once = 4;  // before a person has to ask for more

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
              text("runout_error_from", "error from", { wide: true }), amount("factor_of_safety"), text("reason", "reason", { wide: true }), run],
    triggers: [text("name"), text("kind"), state, amount("transfer_time", "s", "t_T"),
               amount("wanted_time", "s"), amount("lag_s", "s", "lag"), amount("fem_step"), amount("fired_ms", "ms", "fired after"),
               amount("start_ms", "ms", "started after"), text("crossed", "crossed", { wide: true, cell: ({ crossed }) => (crossed ? short_json(crossed) : "–") }), text("snapshot"),
               text("sha256", "SHA-256"), text("fem_task"), run],
};
const of_one_run = ["tasks", "attempts", "results", "triggers"];

const sum = (list, name) => list.reduce((total, each) => total + (each[name] ?? 0), 0);

/// Those of a result; "" where there is none yet, or of an earlier version none that is known.
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

export class Database {
    constructor() {
        this.table = new DataTable(by_id("database-table"));
        by_id("database-run").addEventListener("change", (event) => {
            location.hash = `#/database/${this.name}/${event.target.value}`;
        });
        by_id("database-more").addEventListener("click", () => this.load());
        by_id("database-again").addEventListener("click", () => this.show(this.name, this.run));
    }

    /// name: which table; run: whose, "" for the newest.
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
        await this.load();
    }

    async load() {
        const [name, run] = [this.name, this.run];
        set_text(by_id("database-message"), "Reading…");
        try {
            if (of_one_run.includes(name)) await this.load_of_run(name, run);
            else await this.load_pages(name);
            if (this.name === name && this.run === run) set_text(by_id("database-message"), "");
        } catch (fault) {
            set_text(by_id("database-message"), fault.message);
        }
    }

    async load_of_run(name, wanted) {
        const { runs } = await api.page_of_runs(null, page_size);
        mirror(by_id("database-run"), runs, ({ id }) => id, ({ id }) => element("option", { value: id }),
               (option, each) => set_text(option, `${each.name}, ${each.created.slice(0, 19).replace("T", " ")}`));
        const id = wanted || runs[0]?.id;
        by_id("database-run").value = id ?? "";
        const link = by_id("database-csv");
        link.hidden = name !== "results" || !id;
        if (!link.hidden) link.href = api.results_csv(id);
        const records = id ? await readers[name](await api.read_run(id)) : [];
        if (this.name === name && this.run === wanted) this.fill(records, true);
    }

    /// Runs newest first, events oldest first, until there are no more or enough for now.
    async load_pages(name) {
        by_id("database-csv").hidden = true;
        const records = [...this.records];
        let { place, finished } = this;
        for (let batch = 0; batch < batches_at_once && !finished; batch += 1) {
            const { runs, events, next } = name === "runs" ? await api.page_of_runs(place, page_size)
                                                           : await api.page_of_events(place ?? 0);
            records.push(...(runs?.map((each) => ({ ...each, flags: counts_text(each.flag_counts) })) ?? events));
            finished = name === "runs" ? !next : events.length === 0;
            place = next;
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
