// By what the server knows this page: a token, if it asks for one, and the key of the viewer.
const TOKEN = "gsv-token";

export class Credentials {
  viewer = ""; // the key that the server gave; empty: none yet

  constructor(private readonly storage: Pick<Storage, "getItem" | "setItem"> | null = null) {}

  // For as long as this tab is open.
  get token(): string {
    return this.storage?.getItem(TOKEN) ?? this.given;
  }

  set token(token: string) {
    this.given = token;
    this.storage?.setItem(TOKEN, token);
  }

  private given = "";

  get headers(): Record<string, string> {
    return {
      ...(this.token !== "" && { authorization: `Bearer ${this.token}` }),
      ...(this.viewer !== "" && { "gsv-viewer": this.viewer }),
    };
  }

  // Sends these with each request.
  fetch: typeof fetch = (input, init) =>
    fetch(input, { ...init, headers: { ...(init?.headers as Record<string, string>), ...this.headers } });
}

// Those of this tab. A token at the end of the address (#token=…, which no server and no log sees) is
// taken from there.
export function pageCredentials(window: Window): Credentials {
  const credentials = new Credentials(sessionStorageOf(window));
  const parts = new URLSearchParams(window.location.hash.replace(/^#/, ""));
  const token = parts.get("token");
  if (token) {
    credentials.token = token;
    const rest = window.location.hash.replace(/^#/, "").split("&").filter((part) => !part.startsWith("token="));
    const { pathname, search } = window.location;
    window.history.replaceState(null, "", pathname + search + (rest.length > 0 ? `#${rest.join("&")}` : ""));
  }
  return credentials;
}

function sessionStorageOf(window: Window): Storage | null {
  try {
    return window.sessionStorage;
  } catch {
    return null; // where the browser keeps nothing
  }
}
