// Draws the formulas of a page with KaTeX. Arithmatex marks them, as \( ... \) in lines and \[ ... \] on their own.
addEventListener("DOMContentLoaded", () => {
    for (const formula of document.querySelectorAll(".arithmatex")) {
        const text = formula.textContent.trim();
        katex.render(text.slice(2, -2), formula, {displayMode: text.startsWith("\\["), throwOnError: false});
    }
});
