// The offers of a type: first the matching offers, then the other offers with the reason why they
// do not match.
import { element } from "../ui/element";
import type { Answer, Offer, Term } from "./BrokerApi";

export function offerList({ offers, isCut }: Answer, constraint: string): HTMLElement[] {
  const matching = offers.filter(({ matches }) => matches).length;
  const found = `${matching} of ${countOf(offers.length)} ${offers.length === 1 ? "matches" : "match"}`;
  const summary = constraint === "" || offers.length === 0 ? countOf(offers.length) : found;
  return [
    element("p", { class: "summary", role: "status" }, isCut ? `${summary}; there may be more offers` : summary),
    element("ul", { class: "offers" }, ...offers.map((offer) => offerRow(offer, constraint !== ""))),
  ];
}

function countOf(offers: number): string {
  if (offers === 0) return "No offers";
  return offers === 1 ? "1 offer" : `${offers} offers`;
}

function offerRow(offer: Offer, isAsked: boolean): HTMLElement {
  return element(
    "li",
    { class: "offer card", "data-matches": String(offer.matches) },
    element(
      "div",
      { class: "offer-head" },
      element("span", { class: "dot", "data-phase": offer.matches ? "running" : "none", "aria-hidden": "true" }),
      element("code", {}, offer.address || "no address"),
      isAsked && element("span", { class: "verdict" }, offer.matches ? "matches" : "does not match"),
    ),
    isAsked && element("ul", { class: "terms" }, ...offer.terms.map(termRow)),
    element(
      "dl",
      { class: "properties" },
      ...offer.properties.flatMap(([name, value]) => [
        element("dt", {}, name),
        element("dd", {}, element("code", {}, value)),
      ]),
    ),
  );
}

const MEANING = { true: "true", false: "false", "no value": "no value: the types do not match, or division by 0" };

function termRow({ term, result, missing }: Term): HTMLElement {
  const why = missing.length > 0 ? `no value: the offer has no property ${missing.join(", ")}` : MEANING[result];
  return element(
    "li",
    { class: "term", "data-result": result },
    element("code", {}, term),
    element("span", {}, why),
  );
}
