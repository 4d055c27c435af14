// A subscriber on another DDS stack (eProsima Fast DDS): prints what arrives, octet by octet, and what discovery tells of writers.
//   fastdds_judge DOMAIN SECONDS reliable|best_effort|latched TOPIC TYPE [TOPIC TYPE ...]
// On the loopback interface, or that with the address JUDGE_ADDRESS in the environment, where it asks JUDGE_PEER.
// Lines of JSON: {"topic":..., "cdr":"hex"} a sample, {"writer":topic, "type":..., "user":...} a writer found, {"participant":user data}.
// SPDX-License-Identifier: MIT
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/domain/DomainParticipantListener.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/DataReaderListener.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/topic/Topic.hpp>
#include <fastdds/dds/topic/TopicDataType.hpp>
#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>
#include <fastrtps/utils/IPLocator.h>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace fast = eprosima::fastdds::dds;
namespace rtps = eprosima::fastrtps::rtps;

namespace
{
using Octets = std::vector<uint8_t>;
std::mutex output;
const uint32_t payload_max = 65536;

std::string printable(const std::vector<rtps::octet>& data)
{
    std::string text;
    for (const auto c : data)
    {
        text += c >= 0x20 && c < 0x7F && c != '"' && c != '\\' ? static_cast<char>(c) : '?';
    }
    return text;
}

/// Takes a sample as it came, encapsulation header included.
class Raw : public fast::TopicDataType
{
  public:
    explicit Raw(const char* name)
    {
        setName(name);
        m_typeSize = payload_max;
        m_isGetKeyDefined = false;
    }
    bool serialize(void*, rtps::SerializedPayload_t*) override { return false; }
    bool deserialize(rtps::SerializedPayload_t* payload, void* data) override
    {
        static_cast<Octets*>(data)->assign(payload->data, payload->data + payload->length);
        return true;
    }
    std::function<uint32_t()> getSerializedSizeProvider(void*) override
    {
        return [] { return payload_max; };
    }
    void* createData() override { return new Octets; }
    void deleteData(void* data) override { delete static_cast<Octets*>(data); }
    bool getKey(void*, rtps::InstanceHandle_t*, bool) override { return false; }
};

class Samples : public fast::DataReaderListener
{
    void on_data_available(fast::DataReader* reader) override
    {
        Octets octets;
        fast::SampleInfo info;
        while (reader->take_next_sample(&octets, &info) == eprosima::fastrtps::types::ReturnCode_t::RETCODE_OK)
        {
            if (!info.valid_data)
            {
                continue;
            }
            const std::lock_guard<std::mutex> lock(output);
            std::printf("{\"topic\":\"%s\",\"cdr\":\"", reader->get_topicdescription()->get_name().c_str());
            for (const auto octet : octets)
            {
                std::printf("%02x", octet);
            }
            std::printf("\"}\n");
        }
    }
};

class Discovery : public fast::DomainParticipantListener
{
    void on_publisher_discovery(fast::DomainParticipant*, rtps::WriterDiscoveryInfo&& found) override
    {
        if (found.status != rtps::WriterDiscoveryInfo::DISCOVERED_WRITER)
        {
            return;
        }
        const std::lock_guard<std::mutex> lock(output);
        std::printf("{\"writer\":\"%s\",\"type\":\"%s\",\"user\":\"%s\"}\n", found.info.topicName().c_str(),
                    found.info.typeName().c_str(), printable(found.info.m_qos.m_userData.data_vec()).c_str());
    }
    void on_participant_discovery(fast::DomainParticipant*, rtps::ParticipantDiscoveryInfo&& found) override
    {
        const std::lock_guard<std::mutex> lock(output);
        std::printf("{\"participant\":\"%s\"}\n", printable(found.info.m_userData.data_vec()).c_str());
    }
};

std::string setting(const char* name)
{
    const char* const value = std::getenv(name);
    return value != nullptr ? value : "127.0.0.1";
}

/// UDP on one interface alone, no peers but one.
fast::DomainParticipantQos one_interface()
{
    fast::DomainParticipantQos qos = fast::PARTICIPANT_QOS_DEFAULT;
    auto udp = std::make_shared<eprosima::fastdds::rtps::UDPv4TransportDescriptor>();
    udp->interfaceWhiteList.push_back(setting("JUDGE_ADDRESS"));
    qos.transport().use_builtin_transports = false;
    qos.transport().user_transports.push_back(udp);
    rtps::Locator_t peer;
    rtps::IPLocator::setIPv4(peer, setting("JUDGE_PEER")); // port 0: the first ones of the domain
    qos.wire_protocol().builtin.initialPeersList.push_back(peer);
    return qos;
}
} // namespace

int main(int argc, char** argv)
{
    if (argc < 6 || argc % 2 != 0)
    {
        std::fprintf(stderr, "fastdds_judge DOMAIN SECONDS reliable|best_effort|latched TOPIC TYPE [TOPIC TYPE ...]\n");
        return 2;
    }
    std::setvbuf(stdout, nullptr, _IOLBF, 0);
    Discovery discovery;
    auto* factory = fast::DomainParticipantFactory::get_instance();
    auto* participant = factory->create_participant(static_cast<uint32_t>(std::atoi(argv[1])), one_interface(),
                                                    &discovery, fast::StatusMask::none());
    if (participant == nullptr)
    {
        std::fprintf(stderr, "fastdds_judge: no participant\n");
        return 1;
    }
    auto* subscriber = participant->create_subscriber(fast::SUBSCRIBER_QOS_DEFAULT);
    Samples samples;
    fast::DataReaderQos qos = fast::DATAREADER_QOS_DEFAULT;
    qos.reliability().kind =
        std::strcmp(argv[3], "best_effort") == 0 ? fast::BEST_EFFORT_RELIABILITY_QOS : fast::RELIABLE_RELIABILITY_QOS;
    if (std::strcmp(argv[3], "latched") == 0)
    {
        qos.durability().kind = fast::TRANSIENT_LOCAL_DURABILITY_QOS;
    }
    qos.history().depth = 1000;
    for (int i = 4; i + 1 < argc; i += 2)
    {
        const fast::TypeSupport type(new Raw(argv[i + 1]));
        type.register_type(participant);
        auto* topic = participant->create_topic(argv[i], argv[i + 1], fast::TOPIC_QOS_DEFAULT);
        if (topic == nullptr || subscriber->create_datareader(topic, qos, &samples) == nullptr)
        {
            std::fprintf(stderr, "fastdds_judge: no reader of %s\n", argv[i]);
            return 1;
        }
    }
    std::fprintf(stderr, "ready\n");
    std::this_thread::sleep_for(std::chrono::milliseconds(static_cast<long>(1000 * std::atof(argv[2]))));
    participant->delete_contained_entities();
    factory->delete_participant(participant);
    return 0;
}
