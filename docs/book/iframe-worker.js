// Search in pages that are opened as files: there a browser starts no Worker. This one has the same interface and runs its
// program in a hidden frame. (The theme's own replacement would be loaded from a network.)
if (location.protocol === "file:") {
    const load = (page, url) => new Promise((done, failed) => {
        const script = page.createElement("script");
        script.onload = done;
        script.onerror = () => failed(new Error(`cannot load ${url}`));
        script.src = url;
        page.head.append(script);
    });
    window.IFrameWorker = window.Worker = class extends EventTarget {
        constructor(url) {
            super();
            this.frame = document.createElement("iframe");
            this.frame.hidden = true;
            this.frame.srcdoc = "<!doctype html>";
            this.inside = new Promise(ready => { this.frame.onload = ready; }).then(async () => {
                const inside = this.frame.contentWindow;
                inside.postMessage = data => this.dispatchEvent(new MessageEvent("message", {data}));
                inside.importScripts = async (...urls) => { for (const next of urls) await load(inside.document, next); };
                await load(inside.document, url);
                return inside;
            });
            document.body.append(this.frame);
        }
        postMessage(data) {
            this.inside.then(inside => inside.dispatchEvent(new MessageEvent("message", {data})));
        }
        terminate() { this.frame.remove(); }
    };
}
