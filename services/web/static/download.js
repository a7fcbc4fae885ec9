// Saves files that the page makes.

export function offer_file(name, blob) {
    const link = document.createElement("a");
    link.href = URL.createObjectURL(blob);
    link.download = name;
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 60000);
}

/// A text for file names.
export const file_word = (text) => text.normalize("NFKD").replaceAll(/[^\w.-]+/g, "_").replaceAll(/^_+|_+$/g, "").slice(0, 80) || "breachline";
