import { pageCredentials } from "../api/credentials";
import { JsonServer } from "../api/JsonServer";
import { createJoinPage } from "./JoinPage";

const credentials = pageCredentials(window);
const server = new JsonServer(document.baseURI, credentials.fetch);
const page = createJoinPage(server, (token) => (credentials.token = token));
page.show(document.getElementById("app")!);
void page.follow();
