// Begins tasks that take long, before the rest of the page's script is read: starts the graphics,
// and requests the data that the page shows first.
import { EarlyRequests } from "./api/EarlyRequests";
import { pageCredentials } from "./api/credentials";
import { startGraphics } from "./scene/graphics";

export const parameters = new URLSearchParams(location.search);
export const credentials = pageCredentials(window);
// Resolves to whether the browser draws in software, without a graphics card.
export const graphics = startGraphics();
export const requests = new EarlyRequests(document.baseURI, credentials.fetch);

// If the address contains a recording, the page must open the recording first. So nothing is
// requested early.
if (!parameters.has("recording")) void requests.begin(parameters.get("simulation"));
