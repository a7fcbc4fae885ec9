// A table of records to sort, filter, page through and save as CSV. Independent of their meaning.
import { element, mirror, set_text } from "./dom.js";
import { number } from "./format.js";

const rows_per_page = 50;

export class DataTable {
    /// host: an empty element. open() fills the table.
    constructor(host) {
        this.filter = element("input", { type: "search", placeholder: "words, or column=text", "aria-label": "filter", oninput: () => {
            this.page = 0;
            this.draw();
        } });
        this.count = element("p", { class: "muted", role: "status" });
        this.back = element("button", { type: "button", onclick: () => this.turn(-1) }, "◂ Previous");
        this.forth = element("button", { type: "button", onclick: () => this.turn(1) }, "Next ▸");
        this.csv = element("a", { href: "#", onclick: (event) => this.offer(event) }, "CSV of the filtered rows");
        this.head = element("tr");
        this.body = element("tbody");
        this.region = element("div", { class: "scroll", tabindex: 0, role: "region" },
                              element("table", {}, element("thead", {}, this.head), this.body));
        host.replaceChildren(element("div", { class: "row" }, element("label", {}, "Filter ", this.filter), this.csv, this.count),
                             this.region, element("div", { class: "row" }, this.back, this.forth));
    }

    /// columns: [{name, title, unit, number, cell(record) -> element}]; a record is an object. more: the server has more records.
    open(name, columns, records, more) {
        const same = this.name === name;
        Object.assign(this, { name, columns, records, more });
        if (!same) Object.assign(this, { page: 0, sort: null, falling: false });
        if (!same) this.filter.value = "";
        this.region.setAttribute("aria-label", `table of ${name}`);
        this.draw();
    }

    turn(by) {
        this.page += by;
        this.draw();
        this.region.scrollIntoView({ block: "nearest" });
    }

    sort_by(column) {
        this.falling = this.sort === column ? !this.falling : false;
        this.sort = column;
        this.page = 0;
        this.draw();
    }

    /// Records that match every word of the filter; "state=failed" searches one column only.
    wanted() {
        const words = this.filter.value.toLowerCase().split(/\s+/).filter(Boolean);
        const has = (record, word) => {
            const [, column, text] = word.match(/^(\w+)=(.*)$/) ?? [];
            const meant = this.columns.find(({ name }) => name === column);
            if (meant) return text_in(record, meant).toLowerCase().includes(text);
            return this.columns.some((each) => text_in(record, each).toLowerCase().includes(word));
        };
        const list = this.records.filter((record) => words.every((word) => has(record, word)));
        return this.sort ? list.sort((a, b) => (this.falling ? -1 : 1) * compare(a[this.sort], b[this.sort])) : list;
    }

    draw() {
        const list = this.wanted();
        const pages = Math.max(1, Math.ceil(list.length / rows_per_page));
        this.page = Math.min(Math.max(this.page, 0), pages - 1);
        const first = this.page * rows_per_page;
        const shown = list.slice(first, first + rows_per_page);
        mirror(this.head, this.columns, ({ name, title, unit }) => `${this.name}/${name}/${title}/${unit ?? ""}`, (column) => this.new_head(column), (cell, column) =>
            cell.setAttribute("aria-sort", this.sort !== column.name ? "none" : this.falling ? "descending" : "ascending"));
        this.body.replaceChildren(...shown.map((record) => element("tr", {}, ...this.columns.map((column) => cell_of(record, column)))));
        const filtered = list.length < this.records.length ? ` of ${this.records.length}` : "";
        set_text(this.count, list.length === 0 ? "No rows." : `Rows ${first + 1} to ${first + shown.length} of ${list.length}` +
                 `${filtered && `, filtered from ${this.records.length}`}${this.more ? "; the server has more" : ""}.`);
        this.back.disabled = this.page === 0;
        this.forth.disabled = this.page >= pages - 1;
    }

    new_head(column) {
        return element("th", { scope: "col", class: column.number ? "number" : null }, element("button", { type: "button",
            class: "link sort", onclick: () => this.sort_by(column.name) }, column.title + (column.unit ? ` [${column.unit}]` : "")));
    }

    offer(event) {
        const quoted = (text) => (/[",\r\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text);
        const lines = [this.columns.map(({ name, csv }) => quoted(csv ?? name)), ...this.wanted().map((record) =>
            this.columns.map(({ name }) => quoted(plain(record[name]))))];
        const link = event.currentTarget;
        if (link.href.startsWith("blob:")) URL.revokeObjectURL(link.href);
        link.href = URL.createObjectURL(new Blob([lines.map((line) => line.join(",")).join("\r\n") + "\r\n"], { type: "text/csv" }));
        link.download = `${this.name}.csv`;
    }
}

function plain(value) {
    if (value === null || value === undefined) return "";
    return typeof value === "object" ? JSON.stringify(value) : String(value);
}

function text_in(record, column) {
    return plain(record[column.name]);
}

function cell_of(record, column) {
    const value = record[column.name];
    const content = column.cell ? column.cell(record) : typeof value === "number" ? number(value, 6) : plain(value) || "–";
    return element("td", { class: column.number ? "number" : column.wide ? "message" : null }, content);
}

/// Numbers by size, texts alphabetically; missing values last.
function compare(a, b) {
    const [no_a, no_b] = [a ?? null, b ?? null].map((value) => value === null);
    if (no_a || no_b) return no_a - no_b;
    return typeof a === "number" && typeof b === "number" ? a - b : plain(a).localeCompare(plain(b), undefined, { numeric: true });
}
