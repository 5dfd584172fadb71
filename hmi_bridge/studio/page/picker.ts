// The search for signals: by words, as one types.

import { html } from "./dom";

interface Found { path: string; type: string; unit: string; text: string }

export class Picker {
  readonly input = html("input", { type: "search", placeholder: "Search signals  ( / )", "aria-label": "Search signals",
    autocomplete: "off", spellcheck: "false" });
  private readonly list = html("ul", { class: "found", "aria-label": "Signals found" });
  readonly element = html("section", { class: "picker", "aria-label": "Signals" }, this.input, this.list);
  private asked = 0;

  /// @param search asks the server  @param choose takes a signal into a diagram, a new one if `isNew`
  constructor(private readonly search: (text: string) => Promise<{ signals: Found[] }>,
              private readonly choose: (path: string, isNew: boolean) => void) {
    this.input.addEventListener("input", () => void this.look());
    this.input.addEventListener("keydown", (event) => {
      const first = this.list.querySelector("button");
      if (event.key === "Enter" && first) this.choose(first.dataset.path!, event.shiftKey);
      if (event.key === "ArrowDown") first?.focus();
      if (event.key === "Escape") this.input.blur();
    });
    this.list.addEventListener("keydown", (event) => this.walk(event));
  }

  async look(): Promise<void> {
    const turn = ++this.asked;
    const { signals } = await this.search(this.input.value);
    if (turn !== this.asked) return;  // one has typed on
    this.list.replaceChildren(...signals.map((signal) => html("li", {},
      html("button", { type: "button", "data-path": signal.path, title: signal.text,
        click: ((event: MouseEvent) => this.choose(signal.path, event.shiftKey)) as EventListener },
        html("span", { class: "path" }, signal.path),
        html("span", { class: "unit" }, [signal.type, signal.unit].filter(Boolean).join(" · "))))));
  }

  private walk(event: KeyboardEvent): void {
    if (event.key !== "ArrowDown" && event.key !== "ArrowUp") return;
    event.preventDefault();
    const buttons = [...this.list.querySelectorAll("button")];
    const next = buttons.indexOf(document.activeElement as HTMLButtonElement) + (event.key === "ArrowDown" ? 1 : -1);
    if (next < 0) this.input.focus();
    else buttons[next]?.focus();
  }
}
