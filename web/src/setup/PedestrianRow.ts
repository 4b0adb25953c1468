// The form for one group of pedestrians: their number and their route.
import type { App } from "../app/App";
import type { PedestrianSetUp } from "../api/pedestrians";
import { parseRoute, routeText } from "../api/pedestrians";
import { element, setText } from "../ui/element";
import type { Field } from "../ui/fields";
import { numberField, textField } from "../ui/fields";
import { icon } from "../ui/icons";

const ROUTE_FORM = "one or more places x,y[,radius] in metres, separated by colons, for example -4,0,1:4,0,1";

export class PedestrianRow {
  readonly element: HTMLLIElement;
  private readonly wrong = element("p", { class: "field-error", role: "alert" });
  private readonly title = element("span", { class: "robot-title" });
  private readonly count: Field<number | null>;
  private readonly route: Field<string>;

  constructor(app: App, index: number) {
    const change = (patch: Partial<PedestrianSetUp>) => app.setUp.changePedestrians(index, patch);
    this.count = numberField("Number", 1, (count) => change({ count: count ?? 1 }), { step: "1", least: "1" });
    this.route = textField("Walk between", "places x,y[,radius]:…, for example -4,0,1:4,0,1", (text) => {
      const route = parseRoute(text);
      this.route.refuse(route ? "" : `expected ${ROUTE_FORM}`);
      if (route) change({ route });
    });
    const remove = element(
      "button",
      {
        class: "button plain small",
        type: "button",
        "aria-label": "Remove pedestrians",
        title: "Remove",
        onclick: () => app.setUp.removePedestrians(index),
      },
      icon("close"),
    );
    this.wrong.hidden = true;
    this.element = element(
      "li",
      { class: "set-up-robot", "data-row": `pedestrians[${index}]` },
      element("div", { class: "card-head" }, this.title, remove),
      this.wrong,
      element("div", { class: "field-pair" }, this.count.element, this.route.element),
    );
  }

  show(group: PedestrianSetUp): void {
    setText(this.title, group.name || "pedestrian");
    this.count.show(group.count);
    this.route.show(routeText(group.route));
  }

  // Shows an error at the field `input`, which is "count" or "route". For every other `input`, the
  // error is shown for the whole group.
  refuse(input: string, sentence: string): void {
    this.count.refuse(input === "count" ? sentence : "");
    this.route.refuse(input === "route" ? sentence : "");
    const ofAll = input === "count" || input === "route" ? "" : sentence;
    setText(this.wrong, ofAll);
    this.wrong.hidden = ofAll === "";
  }
}
