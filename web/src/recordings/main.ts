import { pageCredentials } from "../api/credentials";
import { JsonServer } from "../api/JsonServer";
import { createRecordingsPage } from "./RecordingsPage";

const credentials = pageCredentials(window);
const server = new JsonServer(document.baseURI, credentials.fetch);
const page = createRecordingsPage(server, (token) => (credentials.token = token));
page.show(document.getElementById("app")!);
void page.follow();
