// The credentials of this page at the server: a token, if the server requires one, and the key of
// the viewer.
const TOKEN = "gsv-token";

export class Credentials {
  viewer = ""; // the viewer's key, which the server gives; empty until then

  constructor(private readonly storage: Pick<Storage, "getItem" | "setItem"> | null = null) {}

  // Stores the token until this tab is closed.
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

  // Adds the credentials to the headers of a request.
  fetch: typeof fetch = (input, init) =>
    fetch(input, { ...init, headers: { ...(init?.headers as Record<string, string>), ...this.headers } });
}

// Returns the credentials of this tab. If the address ends in #token=…, stores this token and
// removes it from the address. Browsers do not send the part behind "#" to servers.
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
    return null; // this browser stores nothing
  }
}
