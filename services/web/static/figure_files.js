// Saves figures as SVG with inline styles, and as PNG.
import { svg } from "./dom.js";
import { file_word, offer_file } from "./download.js";
import { wrapped } from "./sheet.js";

const styles = ["fill", "fill-opacity", "stroke", "stroke-opacity", "stroke-width", "stroke-dasharray", "stroke-linejoin", "font-size", "font-weight",
                "font-family", "text-anchor", "paint-order"];
const sharpness = 2; // pixels per CSS pixel
const row_height = 22; // of the legend [CSS px]

/// A copy with the same look without the page's style sheet.
function styled_copy(original) {
    const copy = original.cloneNode(true);
    const copies = [copy, ...copy.querySelectorAll("*")];
    [original, ...original.querySelectorAll("*")].forEach((each, i) => {
        const seen = getComputedStyle(each);
        for (const name of styles) copies[i].style.setProperty(name, seen.getPropertyValue(name));
    });
    return copy;
}

/// A plot with its title and legend as one SVG. of: its subject.
export function figure_of({ picture, legend, labels, width, height }, of) {
    const page = getComputedStyle(document.documentElement);
    const font = getComputedStyle(legend);
    const made = [];
    const write = (text, x, y, more = {}) => made.push(svg("text", { x, y, fill: page.getPropertyValue("--text").trim(), "font-size": "13px",
                                                                     "font-family": font.fontFamily, ...more }, text));
    let [x, y] = [12, 12];
    for (const line of wrapped([labels.title, of].filter(Boolean).join(" – "), 13, width - 24, "bold")) {
        write(line, x, y + 10, { "font-weight": "bold" });
        y += 19;
    }
    for (const item of legend.children) {
        const wide = item.getBoundingClientRect().width + 18;
        if (x > 12 && x + wide > width) [x, y] = [12, y + row_height];
        const sign = styled_copy(item.querySelector("svg"));
        sign.setAttribute("x", x);
        sign.setAttribute("y", y);
        made.push(sign);
        write(item.textContent.trim(), x + 30, y + 12);
        x += wide;
    }
    const plot = styled_copy(picture);
    y += legend.children.length ? row_height + 6 : 0;
    for (const [name, value] of Object.entries({ x: 0, y, width, height })) plot.setAttribute(name, value);
    for (const gone of plot.querySelectorAll(".cursor")) gone.remove();
    return svg("svg", { viewBox: `0 0 ${width} ${y + height}`, width, height: y + height },
               svg("rect", { width, height: y + height, fill: page.getPropertyValue("--card").trim() }), ...made, plot);
}

const text_of = (drawing) => `<?xml version="1.0" encoding="UTF-8"?>\n${new XMLSerializer().serializeToString(drawing)}`;

export function offer_svg(name, drawing) {
    offer_file(`${file_word(name)}.svg`, new Blob([text_of(drawing)], { type: "image/svg+xml" }));
}

export async function offer_png(name, drawing) {
    const address = URL.createObjectURL(new Blob([text_of(drawing)], { type: "image/svg+xml" }));
    try {
        const image = new Image();
        image.src = address;
        await image.decode();
        const canvas = document.createElement("canvas");
        canvas.width = sharpness * drawing.getAttribute("width");
        canvas.height = sharpness * drawing.getAttribute("height");
        canvas.getContext("2d").drawImage(image, 0, 0, canvas.width, canvas.height);
        offer_canvas(name, canvas);
    } finally {
        URL.revokeObjectURL(address);
    }
}

export const offer_canvas = (name, canvas) => canvas.toBlob((blob) => offer_file(`${file_word(name)}.png`, blob), "image/png");
