// Makes and updates elements. Independent of Breachline.

/// element("a", {href: "#", class: "plain", onclick: f}, "text", child) -> the new element. Ignores attributes that are null or false.
export function element(tag, attributes = {}, ...children) {
    const made = document.createElement(tag);
    for (const [name, value] of Object.entries(attributes)) {
        if (name.startsWith("on")) made.addEventListener(name.slice(2), value);
        else if (value === true) made.setAttribute(name, "");
        else if (value !== null && value !== undefined && value !== false) made.setAttribute(name, value);
    }
    made.append(...children.filter((child) => child !== null));
    return made;
}

const svg_namespace = "http://www.w3.org/2000/svg";

/// The same for SVG.
export function svg(tag, attributes = {}, ...children) {
    const made = document.createElementNS(svg_namespace, tag);
    for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
    made.append(...children);
    return made;
}

export const by_id = (id) => document.getElementById(id);

/// Writes text only when it differs, so that a screen reader reads only changes.
export function set_text(target, text) {
    if (target.textContent !== text) target.textContent = text;
}

/// Makes the children of `parent` mirror `items`: one child per key, in order. Updates children with known keys in place, so that focus and
/// open details survive.
export function mirror(parent, items, key_of, create, update) {
    const known = new Map([...parent.children].map((child) => [child.dataset.key, child]));
    let place = parent.firstElementChild;
    for (const item of items) {
        const key = String(key_of(item));
        let child = known.get(key);
        if (!child) {
            child = create(item);
            child.dataset.key = key;
        }
        known.delete(key);
        if (child === place) place = place.nextElementSibling;
        else parent.insertBefore(child, place);
        update(child, item);
    }
    for (const gone of known.values()) gone.remove();
}
