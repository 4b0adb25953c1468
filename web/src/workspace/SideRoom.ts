// Makes sure that parts of the column beside the view are high enough. A part that would become too
// low joins the part above it as a tab. It returns to its place later.
import type { DockviewApi, DockviewGroupPanel } from "dockview";

// The minimum height of a part, CSS pixels: its tabs, tools and some lines.
const MIN_PART_PX = 170;

interface Joined {
  panel: string;
  height: number; // height of the part from which the panel has come, CSS pixels
}

export class SideRoom {
  private joined: Joined[] = [];

  constructor(private readonly api: DockviewApi) {}

  // Makes space before the column shrinks to `fraction` of its present height. Joins its lowest
  // parts until each part will have the minimum height. `column` contains its parts, from the top.
  make(column: readonly DockviewGroupPanel[], fraction: number): void {
    const parts = [...column];
    const height = fraction * parts.reduce((sum, part) => sum + part.height, 0);
    while (parts.length > 1 && height / parts.length < MIN_PART_PX) {
      const low = parts.pop()!;
      const above = parts.at(-1)!;
      const front = above.activePanel;
      for (const panel of [...low.panels]) {
        this.joined.push({ panel: panel.id, height: low.height });
        panel.api.moveTo({ group: above, skipSetActive: true });
      }
      front?.api.setActive();
    }
  }

  // Moves the panels that have joined another part back to a part below it.
  restore(): void {
    const joined = this.joined;
    this.joined = [];
    for (const { panel: id, height } of joined) {
      const panel = this.api.getPanel(id);
      if (!panel || panel.api.location.type !== "grid" || panel.group.panels.length < 2) continue;
      const { group } = panel;
      const front = group.activePanel;
      panel.api.moveTo({ group, position: "bottom" });
      // Now the part of the closed panel still takes space, so the height is set after its removal.
      queueMicrotask(() => panel.group.api.setSize({ height }));
      if (front && front !== panel) front.api.setActive();
    }
  }

  // Discards the stored parts. Call this when another layout is shown.
  forget(): void {
    this.joined = [];
  }
}
