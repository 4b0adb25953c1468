import { pageCredentials } from "../api/credentials";
import { JsonServer } from "../api/JsonServer";
import { createJoinPage } from "./JoinPage";

const page = createJoinPage(new JsonServer(document.baseURI, pageCredentials(window).fetch));
page.show(document.getElementById("app")!);
void page.follow();
