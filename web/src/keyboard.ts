/** What keys do; a call returns nothing. */
export type KeyCalls = Record<string, () => void>;

/** Listens to keys everywhere but in fields that take text or have keys of their own. */
export function listenToKeys(calls: KeyCalls): void {
  document.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const target = event.target as HTMLElement;
    const open = document.querySelector("dialog[open]");
    if (open && event.key !== "?") return;
    if (target.closest("select, textarea, input:not([type=checkbox])")) return;
    // Space presses a focused button, and nothing else.
    if (event.key === " " && target.closest("button, input, summary")) return;
    // Lists scroll by themselves.
    if (/^(Page|Home|End)/.test(event.key) && target.closest(".rows")) return;
    const call = calls[event.key] ?? calls[event.key.toLowerCase()];
    if (!call) return;
    event.preventDefault();
    call();
  });

  // After a click, keys are the page's again; who moves by keys keeps the focus.
  document.addEventListener("click", (event) => {
    if (event.detail === 0) return; // by a key
    releaseFocus();
    setTimeout(releaseFocus); // labels hand it on to their switch
  });
}

function releaseFocus(): void {
  const at = document.activeElement;
  if (at instanceof HTMLElement && at.matches("button, input[type=checkbox]") && !at.closest("dialog")) at.blur();
}
