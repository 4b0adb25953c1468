import { JsonServer } from "../api/JsonServer";
import { createJoinPage } from "./JoinPage";

const page = createJoinPage(new JsonServer(document.baseURI));
page.show(document.getElementById("app")!);
void page.follow();
