import "../style/broker.css";
import { pageCredentials } from "../api/credentials";
import { JsonServer } from "../api/JsonServer";
import { BrokerApi } from "./BrokerApi";
import { BrokerPage } from "./BrokerPage";

const credentials = pageCredentials(window);
const api = new BrokerApi(new JsonServer(document.baseURI, credentials.fetch));
const page = new BrokerPage(api, (token) => (credentials.token = token));
page.show(document.getElementById("app")!);
void page.load();
