// What the page begins before the rest of its script is read, because it takes long: the start of the
// graphics, and the requests for what is shown first.
import { EarlyRequests } from "./api/EarlyRequests";
import { pageCredentials } from "./api/credentials";
import { startGraphics } from "./scene/graphics";

export const parameters = new URLSearchParams(location.search);
export const credentials = pageCredentials(window);
// Whether the browser draws in software.
export const graphics = startGraphics();
export const requests = new EarlyRequests(document.baseURI, credentials.fetch);

// A recording is opened first.
if (!parameters.has("recording")) void requests.begin(parameters.get("simulation"));
