import { JsonServer } from "../api/JsonServer";
import { createRecordingsPage } from "./RecordingsPage";

const page = createRecordingsPage(new JsonServer(document.baseURI));
page.show(document.getElementById("app")!);
void page.follow();
