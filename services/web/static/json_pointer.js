// Where a JSON pointer (RFC 6901) points to in the text of a document.

/// {start, end} of the value in `text`, or of its nearest parent that is there; null when the text is not JSON so far.
export function find_pointer(text, pointer) {
    const wanted = pointer.split("/").slice(1).map((part) => part.replaceAll("~1", "/").replaceAll("~0", "~"));
    let best = null;
    let at = 0;

    const skip_space = () => {
        while (at < text.length && " \t\r\n".includes(text[at])) at += 1;
    };
    const take_string = () => {
        const start = at;
        for (at += 1; at < text.length && text[at] !== '"'; at += 1) if (text[at] === "\\") at += 1;
        at += 1;
        return JSON.parse(text.slice(start, at));
    };
    // depth: how many parts of the pointer led here; -1 off the way.
    const take_value = (depth) => {
        skip_space();
        const start = at;
        if (text[at] === "{" || text[at] === "[") take_members(depth);
        else if (text[at] === '"') take_string();
        else while (at < text.length && !",]} \t\r\n".includes(text[at])) at += 1;
        if (depth >= 0 && (best === null || depth > best.depth)) best = { start, end: at, depth };
    };
    const take_members = (depth) => {
        const is_object = text[at] === "{";
        const close = is_object ? "}" : "]";
        at += 1;
        for (let index = 0; ; index += 1) {
            skip_space();
            if (at >= text.length || text[at] === close) break;
            const key = is_object ? take_string() : String(index);
            skip_space();
            if (is_object && text[at] === ":") at += 1;
            take_value(depth >= 0 && depth < wanted.length && key === wanted[depth] ? depth + 1 : -1);
            skip_space();
            if (text[at] !== ",") break;
            at += 1;
        }
        at += 1;
    };

    try {
        take_value(0);
    } catch {
        return best; // a broken string: what was found before it
    }
    return best;
}
