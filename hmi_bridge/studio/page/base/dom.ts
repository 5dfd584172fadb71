// Elements, made of names, attributes and children. Text is always text, never markup.

type Attributes = Record<string, string | number | boolean | EventListener | undefined>;
type Child = Node | string;

function fill<E extends Element>(element: E, attributes: Attributes, children: Child[]): E {
  for (const [name, value] of Object.entries(attributes)) {
    if (typeof value === "function") element.addEventListener(name, value);
    else if (typeof value === "boolean") element.toggleAttribute(name, value);
    else if (value !== undefined) element.setAttribute(name, String(value));
  }
  element.append(...children);
  return element;
}

export function html<K extends keyof HTMLElementTagNameMap>(
  name: K, attributes: Attributes = {}, ...children: Child[]): HTMLElementTagNameMap[K] {
  return fill(document.createElement(name), attributes, children);
}

export function svg<K extends keyof SVGElementTagNameMap>(
  name: K, attributes: Attributes = {}, ...children: Child[]): SVGElementTagNameMap[K] {
  return fill(document.createElementNS("http://www.w3.org/2000/svg", name), attributes, children);
}

/// A button that says what it does, and its key where it has one.
export function button(label: string, title: string, click: () => void): HTMLButtonElement {
  return html("button", { type: "button", title, click }, label);
}

/// By what one knows an element again that has been made anew.
const nameOf = (element: Element): string => element.tagName + ["data-trace", "data-line", "aria-label", "title"].map((name) => element.getAttribute(name) ?? "").join("|") + (element.getAttribute("data-trace") ? "" : element.textContent);

/// Gives an element these children. One that looks as it did stays what it is, so that a click that has begun on it, its focus and
/// what is typed into it are not lost when a list is told anew.
export function renew(parent: Element, children: Element[]): void {
  const focused = parent.contains(document.activeElement) && document.activeElement!.matches(":focus-visible") ? document.activeElement! : null;
  const before = new Map<string, Element[]>();
  const isAsWritten = (element: Element): boolean => [...element.querySelectorAll("input")].every((input) => input.checked === input.defaultChecked);
  for (const child of parent.children) if (isAsWritten(child)) before.set(child.outerHTML, [...(before.get(child.outerHTML) ?? []), child]);
  const kept = children.map((child) => before.get(child.outerHTML)?.shift() ?? child);
  for (const child of [...parent.children]) if (!kept.includes(child)) child.remove();
  let at = parent.firstElementChild;
  for (const child of kept)
    if (child === at) at = at.nextElementSibling;
    else parent.insertBefore(child, at);
  // Who works by keys goes on where he was, though what he has chosen looks otherwise now.
  if (focused && document.activeElement !== focused)
    [...parent.querySelectorAll<HTMLElement>(focused.tagName)].find((one) => one === focused || nameOf(one) === nameOf(focused))?.focus({ preventScroll: true });
}

/// Saves what the page has made, as the browser saves files.
export function save(blob: Blob, name: string): void {
  const address = URL.createObjectURL(blob);
  html("a", { href: address, download: name }).click();
  setTimeout(() => URL.revokeObjectURL(address), 10_000);
}
