// Requests about the server's broker. Every call returns an answer, or throws an error: the
// server's error message, or a timeout.
import type { JsonServer } from "../api/JsonServer";
import type { JsonObject } from "../api/json";
import { listAt, objectAt, textAt, textOr } from "../api/json";

export interface PropertyDefinition {
  name: string;
  type: string; // "sequence<string>"
  mandatory: boolean;
  readonly: boolean;
}

export interface ServiceType {
  name: string;
  interfaceName: string;
  superTypes: string[];
  masked: boolean;
  properties: PropertyDefinition[];
}

export type Result = "true" | "false" | "no value";

// One term of a constraint, and whether an offer satisfies it.
export interface Term {
  term: string;
  result: Result;
  missing: string[]; // required properties that the offer lacks
}

export interface Offer {
  address: string;
  properties: [name: string, value: string][]; // values in JSON notation
  matches: boolean;
  terms: Term[];
}

// The offers that were found for a question.
export interface Answer {
  offers: Offer[]; // matching offers in the order of preference, followed by the other offers
  isCut: boolean; // whether there are more offers than these
}

// A link to another broker.
export interface Link {
  name: string;
  address: string;
  rules: string;
  answers: boolean;
}

// The service type, the constraint and the preference of a query.
export interface Question {
  type: string;
  constraint: string;
  preference: string;
}

const TIMEOUT_MS = 20_000;

export class BrokerApi {
  constructor(private readonly server: JsonServer) {}

  async types(): Promise<{ broker: string; types: ServiceType[] }> {
    const answer = objectAt(await this.get("types"), "types");
    const types = listAt(answer.types, "types").map((type, i) => parseType(objectAt(type, `types[${i}]`)));
    types.sort((a, b) => a.name.localeCompare(b.name));
    return { broker: textOr(answer.broker, ""), types };
  }

  async offers(question: Question): Promise<Answer> {
    // URLSearchParams is not used because it writes a space as "+". For the server, "+" is a plus.
    const query = Object.entries(question).map(([name, value]) => `${name}=${encodeURIComponent(value)}`);
    const answer = objectAt(await this.get(`offers?${query.join("&")}`), "offers");
    return {
      offers: listAt(answer.offers, "offers").map((offer, i) => parseOffer(objectAt(offer, `offers[${i}]`))),
      isCut: answer.cut === true,
    };
  }

  async links(): Promise<Link[]> {
    const answer = objectAt(await this.get("links"), "links");
    return listAt(answer.links, "links").map((link, i) => parseLink(objectAt(link, `links[${i}]`)));
  }

  private get(path: string): Promise<unknown> {
    return this.server.get(`api/broker/${path}`, TIMEOUT_MS);
  }
}

function parseType(type: JsonObject): ServiceType {
  return {
    name: textAt(type.name, "name"),
    interfaceName: textOr(type.interface, ""),
    superTypes: listAt(type.super_types ?? [], "super_types").map((name) => textAt(name, "super_types")),
    masked: type.masked === true,
    properties: listAt(type.properties ?? [], "properties").map((each) => {
      const property = objectAt(each, "property");
      return {
        name: textAt(property.name, "name"),
        type: textAt(property.type, "type"),
        mandatory: property.mandatory === true,
        readonly: property.readonly === true,
      };
    }),
  };
}

function parseOffer(offer: JsonObject): Offer {
  return {
    address: textOr(offer.address, ""),
    properties: Object.entries(objectAt(offer.properties, "properties")).map(([name, value]) => [
      name,
      JSON.stringify(value),
    ]),
    matches: offer.matches === true,
    terms: listAt(offer.terms ?? [], "terms").map((each) => {
      const term = objectAt(each, "term");
      return {
        term: textAt(term.term, "term"),
        result: resultOf(term.result),
        missing: listAt(term.missing ?? [], "missing").map((name) => textAt(name, "missing")),
      };
    }),
  };
}

function resultOf(text: unknown): Result {
  return text === "true" || text === "false" ? text : "no value";
}

function parseLink(link: JsonObject): Link {
  return {
    name: textAt(link.name, "name"),
    address: textOr(link.address, ""),
    rules: `${textOr(link.def_pass_on_follow_rule, "")} · ${textOr(link.limiting_follow_rule, "")}`,
    answers: link.answers === true,
  };
}
