// Light or dark, as the system has it or as one has chosen; and the colours of signals, which go with it.

const kTheme = "lockstep-theme";
const kColours = 8;  // in the style sheet
const kPrinted = ["#0067b1", "#b84300", "#00734f", "#96308c", "#7a5c00", "#3d3d3d", "#b3003c", "#007a8a"];

export class Theme {
  private colours: string[] = [];
  line = "#888888";  // of grids

  constructor(private readonly changed: () => void) {
    this.set(localStorage.getItem(kTheme) ?? "");
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.read());
  }

  toggle(): void { this.set(this.isDark() ? "light" : "dark"); this.changed(); }

  colour(index: number): string { return this.colours[index % kColours]; }
  /// On white paper, whatever the screen looks like.
  printed(index: number): string { return kPrinted[index % kColours]; }

  private isDark(): boolean {
    const chosen = document.documentElement.dataset.theme;
    return chosen ? chosen === "dark" : matchMedia("(prefers-color-scheme: dark)").matches;
  }

  private set(theme: string): void {
    if (theme) {
      document.documentElement.dataset.theme = theme;
      localStorage.setItem(kTheme, theme);
    }
    this.read();
  }

  private read(): void {
    const style = getComputedStyle(document.documentElement);
    this.colours = Array.from({ length: kColours }, (_, i) => style.getPropertyValue(`--signal-${i}`).trim());
    this.line = style.getPropertyValue("--grid").trim() || this.line;
    this.changed();
  }
}
