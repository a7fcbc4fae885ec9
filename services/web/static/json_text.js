// Locates JSON pointers (RFC 6901) in a JSON text, and edits the text without changing any other byte.

const width = 110; // [characters] that a value may take on one line

export const parts_of = (pointer) => pointer.split("/").slice(1).map((part) => part.replaceAll("~1", "/").replaceAll("~0", "~"));
export const pointer_of = (parts) => parts.map((part) => `/${String(part).replaceAll("~", "~0").replaceAll("/", "~1")}`).join("");

/// The document as a tree of {start, end}, with `members` (name -> {name_start, name_end, node}) of an object and `items` of an array. For
/// invalid JSON: the part before the error.
export function scan(text) {
    let at = 0;
    const skip_space = () => {
        while (at < text.length && " \t\r\n".includes(text[at])) at += 1;
    };
    const skip_string = () => {
        for (at += 1; at < text.length && text[at] !== '"'; at += 1) if (text[at] === "\\") at += 1;
        at += 1;
    };
    const fill = (node) => {
        if (text[at] === "{" || text[at] === "[") fill_inside(node, text[at] === "{");
        else if (text[at] === '"') skip_string();
        else while (at < text.length && !",]} \t\r\n".includes(text[at])) at += 1;
        node.end = Math.min(at, text.length);
    };
    const fill_inside = (node, is_object) => {
        if (is_object) node.members = new Map();
        else node.items = [];
        const close = is_object ? "}" : "]";
        for (at += 1; ; at += 1) {
            skip_space();
            if (at >= text.length || text[at] === close) break;
            const name_start = at;
            let name;
            if (is_object) {
                skip_string();
                name = JSON.parse(text.slice(name_start, at));
            }
            const name_end = at;
            skip_space();
            if (is_object && text[at] === ":") at += 1;
            skip_space();
            const child = { start: at, end: text.length };
            if (is_object) node.members.set(name, { name_start, name_end, node: child });
            else node.items.push(child);
            fill(child);
            skip_space();
            if (text[at] !== ",") break;
        }
        at += 1;
    };
    skip_space();
    const root = { start: at, end: text.length };
    try {
        fill(root);
    } catch (fault) {
        if (!(fault instanceof SyntaxError)) throw fault; // a broken name: keep what was found before it
    }
    return root;
}

const child_of = (node, part) => node.members?.get(part)?.node ?? node.items?.[Number(part)];

/// The nodes on the path, as far as it exists.
function way_to(root, parts) {
    const way = [root];
    for (const part of parts) {
        const next = child_of(way.at(-1), part);
        if (!next) break;
        way.push(next);
    }
    return way;
}

/// {start, end} of the value, or of its nearest existing parent.
export const find_pointer = (text, pointer) => way_to(scan(text), parts_of(pointer)).at(-1);

/// Prints short values on one line, and fills the lines of number lists.
export function print(value, indent = "", unit = "    ") {
    if (value === null || typeof value !== "object") return JSON.stringify(value);
    const is_list = Array.isArray(value);
    const flat = is_list ? `[${value.map((each) => print(each, "", "")).join(", ")}]`
        : Object.keys(value).length === 0 ? "{}"
        : `{ ${Object.entries(value).map(([name, each]) => `${JSON.stringify(name)}: ${print(each, "", "")}`).join(", ")} }`;
    if (unit === "" || (flat.length + indent.length <= width && (is_list || !Object.values(value).some(is_deep)))) return flat;
    const inner = indent + unit;
    if (!is_list) {
        return `{\n${Object.entries(value).map(([name, each]) => `${inner}${JSON.stringify(name)}: ${print(each, inner, unit)}`).join(",\n")}\n${indent}}`;
    }
    if (value.some((each) => each !== null && typeof each === "object" && !Array.isArray(each))) {
        return `[\n${value.map((each) => inner + print(each, inner, unit)).join(",\n")}\n${indent}]`;
    }
    const lines = [inner];
    value.forEach((each, i) => {
        const piece = print(each, "", "") + (i + 1 < value.length ? ", " : "");
        if (lines.at(-1) !== inner && lines.at(-1).length + piece.length > width) lines.push(inner);
        lines[lines.length - 1] += piece;
    });
    return `[\n${lines.map((line) => line.trimEnd()).join("\n")}\n${indent}]`;
}
const is_deep = (value) => value !== null && typeof value === "object" && !Array.isArray(value) &&
    Object.values(value).some((each) => each !== null && typeof each === "object");

const line_indent = (text, at) => text.slice(text.lastIndexOf("\n", at - 1) + 1).match(/^[ \t]*/)[0];
const unit_of = (text) => text.match(/\n([ \t]+)"/)?.[1] ?? "    ";
const splice = (text, start, end, by) => text.slice(0, start) + by + text.slice(end);
const last_of = (node) => (node.members ? [...node.members.values()].at(-1)?.node : node.items.at(-1));
const first_start = (node) => (node.members ? [...node.members.values()][0]?.name_start : node.items[0]?.start);

/// The separator between two entries of a container: a new line if its first entry begins one.
function between(text, node) {
    const first = first_start(node);
    return text.slice(node.start, first).includes("\n") ? `\n${line_indent(text, first)}` : " ";
}

/// Appends an entry to the container; `name`: null in a list.
function append(text, node, name, value) {
    const head = name === null ? "" : `${JSON.stringify(name)}: `;
    const unit = unit_of(text);
    const last = last_of(node);
    if (last) {
        const gap = between(text, node);
        return splice(text, last.end, last.end, `,${gap}${head}${print(value, gap.length > 1 ? gap.slice(1) : "", gap.length > 1 ? unit : "")}`);
    }
    const indent = line_indent(text, node.start);
    const [open, close] = name === null ? "[]" : "{}";
    const flat = head + print(value, "", "");
    if (value === null || typeof value !== "object") return splice(text, node.start, node.end, name === null ? `[${flat}]` : `{ ${flat} }`);
    return splice(text, node.start, node.end, `${open}\n${indent}${unit}${head}${print(value, indent + unit, unit)}\n${indent}${close}`);
}

/// Sets `value` at `parts`; creates missing parents.
export function set_value(text, parts, value) {
    if (text.trim() === "") return print(parts.reduceRight((inner, part) => ({ [part]: inner }), value));
    const way = way_to(scan(text), parts);
    const node = way.at(-1);
    const missing = parts.slice(way.length - 1);
    if (missing.length === 0) return splice(text, node.start, node.end, print(value, line_indent(text, node.start), unit_of(text)));
    const inner = missing.slice(1).reduceRight((made, part) => ({ [part]: made }), value);
    if (!node.members && !node.items) return splice(text, node.start, node.end, print({ [missing[0]]: inner }, line_indent(text, node.start), unit_of(text)));
    if (node.items && !/^\d+$/.test(missing[0])) return text; // a list has no such entry
    return append(text, node, node.items ? null : missing[0], inner);
}

/// Removes the entry at `parts`, and its comma.
export function remove_value(text, parts) {
    const way = way_to(scan(text), parts);
    if (way.length <= parts.length) return text;
    const holder = way.at(-2);
    const spans = holder.members ? [...holder.members.values()].map(({ name_start, node }) => [name_start, node.end])
        : holder.items.map(({ start, end }) => [start, end]);
    const at = spans.findIndex(([, end]) => end === way.at(-1).end);
    if (spans.length === 1) return splice(text, holder.start, holder.end, holder.members ? "{}" : "[]");
    return at + 1 < spans.length ? splice(text, spans[at][0], spans[at + 1][0], "") : splice(text, spans[at - 1][1], spans[at][1], "");
}

/// Inserts `value` before the list's item `index`, or after the last item.
export function insert_item(text, parts, index, value) {
    const way = way_to(scan(text), parts);
    if (way.length <= parts.length) return set_value(text, parts, [value]);
    const list = way.at(-1);
    if (index >= list.items.length) return append(text, list, null, value);
    const gap = between(text, list);
    const start = list.items[index].start;
    return splice(text, start, start, `${print(value, gap.length > 1 ? gap.slice(1) : "", gap.length > 1 ? unit_of(text) : "")},${gap}`);
}

/// Swaps two items of a list.
export function swap_items(text, parts, one, other) {
    const { items } = way_to(scan(text), parts).at(-1);
    const [first, second] = [items[Math.min(one, other)], items[Math.max(one, other)]];
    return text.slice(0, first.start) + text.slice(second.start, second.end) + text.slice(first.end, second.start) +
        text.slice(first.start, first.end) + text.slice(second.end);
}

/// Renames a member of an object.
export function rename_member(text, parts, name) {
    const { members } = way_to(scan(text), parts.slice(0, -1)).at(-1);
    const { name_start, name_end } = members.get(parts.at(-1));
    return splice(text, name_start, name_end, JSON.stringify(name));
}
