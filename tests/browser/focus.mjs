// Looks for controls whose keyboard focus cannot be seen (WCAG 2.4.7).

// Focuses each visible control as the keyboard does. Returns the names of controls whose focus
// cannot be seen: they have no outline of at least 1 px, and the focus does not change their shadow,
// border or background.
export async function controlsWithoutVisibleFocus(page) {
  return page.evaluate(() => {
    const lookOf = (control) => {
      const style = getComputedStyle(control);
      const hasOutline = style.outlineStyle !== "none" && parseFloat(style.outlineWidth) >= 1;
      return { hasOutline, other: [style.boxShadow, style.borderColor, style.backgroundColor].join() };
    };
    const focused = document.activeElement;
    const unseen = [];
    for (const control of document.querySelectorAll("a[href], button, input, select, textarea, summary, [tabindex]")) {
      if (control.disabled || control.tabIndex < 0 || !control.checkVisibility({ visibilityProperty: true })) continue;
      control.blur();
      const before = lookOf(control);
      control.focus({ focusVisible: true, preventScroll: true });
      const now = lookOf(control);
      const hasFocus = document.activeElement === control;
      if (hasFocus && !now.hasOutline && now.other === before.other) unseen.push(control.getAttribute("aria-label") ?? control.textContent.trim());
    }
    if (focused instanceof HTMLElement) focused.focus({ preventScroll: true });
    return unseen;
  });
}
