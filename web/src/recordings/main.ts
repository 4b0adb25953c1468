import { pageCredentials } from "../api/credentials";
import { JsonServer } from "../api/JsonServer";
import { createRecordingsPage } from "./RecordingsPage";

const page = createRecordingsPage(new JsonServer(document.baseURI, pageCredentials(window).fetch));
page.show(document.getElementById("app")!);
void page.follow();
