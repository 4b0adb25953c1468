// Expressions over fields: "hypot({/a/odom twist.twist.linear.x}, {a speed}) * 3.6". A reference is
// written in braces: {OWNER FIELD}. OWNER is a topic, the name of a robot, or "simulation".
//
// The expression's length, its depth of nesting and its number of references are bounded. Only
// arithmetic is evaluated.

const MAX_LENGTH = 300;
const MAX_DEPTH = 50;
const MAX_REFERENCES = 8;

const CONSTANTS: Readonly<Record<string, number>> = { pi: Math.PI, e: Math.E };
const FUNCTIONS: Readonly<Record<string, { least: number; most: number; of: (...values: number[]) => number }>> = {
  abs: { least: 1, most: 1, of: Math.abs },
  sqrt: { least: 1, most: 1, of: Math.sqrt },
  exp: { least: 1, most: 1, of: Math.exp },
  log: { least: 1, most: 1, of: Math.log },
  sin: { least: 1, most: 1, of: Math.sin },
  cos: { least: 1, most: 1, of: Math.cos },
  tan: { least: 1, most: 1, of: Math.tan },
  asin: { least: 1, most: 1, of: Math.asin },
  acos: { least: 1, most: 1, of: Math.acos },
  atan2: { least: 2, most: 2, of: Math.atan2 },
  floor: { least: 1, most: 1, of: Math.floor },
  round: { least: 1, most: 1, of: Math.round },
  sign: { least: 1, most: 1, of: Math.sign },
  deg: { least: 1, most: 1, of: (radians) => (radians * 180) / Math.PI },
  rad: { least: 1, most: 1, of: (degrees) => (degrees * Math.PI) / 180 },
  hypot: { least: 1, most: 8, of: Math.hypot },
  min: { least: 1, most: 8, of: Math.min },
  max: { least: 1, most: 8, of: Math.max },
};
export const FUNCTION_NAMES: readonly string[] = Object.keys(FUNCTIONS);

export interface Reference {
  of: string; // a topic, a robot's name, or "simulation"
  key: string;
}

export interface Expression {
  references: readonly Reference[];
  // Evaluates the expression. `values` are the values of the references, in their order.
  evaluate(values: readonly number[]): number;
}

type Term = (values: readonly number[]) => number;

// Parses an expression. Throws an Error with a sentence for the user.
export function parseExpression(text: string): Expression {
  if (text.trim() === "") throw new Error("The expression is empty. Type for example {pebble speed} * 3.6.");
  if (text.length > MAX_LENGTH) throw new Error(`The expression is longer than ${MAX_LENGTH} characters.`);
  const parser = new Parser(tokensOf(text));
  const term = parser.whole();
  return { references: parser.references, evaluate: term };
}

interface Token {
  kind: "number" | "name" | "reference" | "sign" | "end";
  text: string;
  at: number; // counted from 1
}

function tokensOf(text: string): Token[] {
  const tokens: Token[] = [];
  const pattern = /\s*(?:((?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)|([A-Za-z_]\w*)|\{([^{}]*)\}|([-+*/^(),]))/y;
  const end = text.trimEnd().length;
  while (pattern.lastIndex < end) {
    const from = pattern.lastIndex;
    const found = pattern.exec(text);
    const rest = text.slice(from).trimStart();
    const at = text.length - rest.length + 1;
    if (!found) {
      if (rest.startsWith("{")) throw new Error(`The brace at character ${at} is not closed.`);
      throw new Error(`The expression cannot have "${rest[0]}" at character ${at}.`);
    }
    const [, number, name, reference, sign] = found;
    if (number !== undefined) tokens.push({ kind: "number", text: number, at });
    else if (name !== undefined) tokens.push({ kind: "name", text: name, at });
    else if (reference !== undefined) tokens.push({ kind: "reference", text: reference.trim(), at });
    else tokens.push({ kind: "sign", text: sign!, at });
  }
  return [...tokens, { kind: "end", text: "the end", at: text.length + 1 }];
}

class Parser {
  readonly references: Reference[] = [];
  private next = 0;
  private depth = 0;

  constructor(private readonly tokens: readonly Token[]) {}

  whole(): Term {
    const term = this.sum();
    if (this.peek.kind !== "end") throw this.unexpected();
    return term;
  }

  private get peek(): Token {
    return this.tokens[this.next]!;
  }

  private take(sign: string): boolean {
    if (this.peek.kind !== "sign" || this.peek.text !== sign) return false;
    this.next += 1;
    return true;
  }

  private unexpected(): Error {
    const { kind, text, at } = this.peek;
    return new Error(kind === "end" ? "The expression is not complete." : `"${text}" at character ${at} is not expected there.`);
  }

  private sum(): Term {
    let left = this.product();
    for (;;) {
      const [a, isSum] = [left, this.take("+")];
      if (!isSum && !this.take("-")) return left;
      const b = this.product();
      left = isSum ? (values) => a(values) + b(values) : (values) => a(values) - b(values);
    }
  }

  private product(): Term {
    let left = this.negated();
    for (;;) {
      const [a, isProduct] = [left, this.take("*")];
      if (!isProduct && !this.take("/")) return left;
      const b = this.negated();
      left = isProduct ? (values) => a(values) * b(values) : (values) => a(values) / b(values);
    }
  }

  private negated(): Term {
    if (++this.depth > MAX_DEPTH) throw new Error("The expression is nested too deeply.");
    const isNegative = this.take("-");
    const term = isNegative ? this.negated() : this.power();
    this.depth -= 1;
    return isNegative ? (values) => -term(values) : term;
  }

  private power(): Term {
    const base = this.atom();
    if (!this.take("^")) return base;
    const exponent = this.negated();
    return (values) => base(values) ** exponent(values);
  }

  private atom(): Term {
    const token = this.peek;
    if (this.take("(")) {
      const inner = this.sum();
      this.close();
      return inner;
    }
    if (token.kind === "end" || token.kind === "sign") throw this.unexpected();
    this.next += 1;
    if (token.kind === "number") return () => Number(token.text);
    if (token.kind === "reference") return this.reference(token);
    return this.take("(") ? this.call(token) : constant(token);
  }

  private close(): void {
    if (!this.take(")")) throw this.peek.kind === "end" ? new Error("A bracket is not closed.") : this.unexpected();
  }

  private call({ text, at }: Token): Term {
    const known = Object.hasOwn(FUNCTIONS, text) ? FUNCTIONS[text] : undefined;
    if (!known) throw new Error(`There is no function ${text} (character ${at}). Known: ${FUNCTION_NAMES.join(", ")}.`);
    const given: Term[] = [this.sum()];
    while (this.take(",")) given.push(this.sum());
    this.close();
    if (given.length < known.least || given.length > known.most) {
      throw new Error(`${text} takes ${known.least === known.most ? known.least : `${known.least} to ${known.most}`} values, not ${given.length}.`);
    }
    return (values) => known.of(...given.map((each) => each(values)));
  }

  private reference({ text, at }: Token): Term {
    const found = /^(.*\S)\s+(\S+)$/.exec(text);
    if (!found) throw new Error(`{${text}} at character ${at} must name a topic or a robot, and a field: {pebble speed}.`);
    const [of, key] = [found[1]!, found[2]!];
    let index = this.references.findIndex((each) => each.of === of && each.key === key);
    if (index < 0) index = this.references.push({ of, key }) - 1;
    if (this.references.length > MAX_REFERENCES) throw new Error(`An expression has at most ${MAX_REFERENCES} different fields.`);
    return (values) => values[index]!;
  }
}

function constant({ text, at }: Token): Term {
  const value = Object.hasOwn(CONSTANTS, text) ? CONSTANTS[text] : undefined;
  if (value === undefined) throw new Error(`"${text}" at character ${at} is not known. Put fields into braces: {pebble speed}.`);
  return () => value;
}
