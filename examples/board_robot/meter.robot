*** Settings ***
Documentation     The voltmeter of ../board_pytest: robot --variable IMAGE:../board_pytest/meter.ihx meter.robot
Library           libins.robot
Test Setup        Reset Emulation

*** Variables ***
${IMAGE}          ${CURDIR}/../board_pytest/meter.ihx

*** Test Cases ***
Boots
    Create Machine              firmware=${IMAGE}
    Create Terminal Tester      sysbus.uart    timeout=0.5
    Start Emulation
    ${ready}=                   Wait For Line On Uart    READY
    Should Be True              0.25 < ${ready.timestamp} < 0.27
    Provides                    booted

Reads A Volt And A Quarter
    Requires                    booted
    Set Volts                   3    1.25
    Write To Uart               3?
    ${reading}=                 Wait For Line On Uart    AIN(\\d) (\\d+) mV    treatAsRegex=true    timeout=0.05
    Should Be Equal             ${reading.line}    AIN3 1250 mV
    Should Be Equal             ${reading.groups}[1]    1250

Lamp Shows The Limit Exceeded
    Requires                    booted
    Set Variable Of Firmware    limit_mv    1000
    Write Char On Uart          ?
    Wait For Prompt On Uart     2500 mV
    Pin Should Be               P2.0    ${False}
    ${count}=                   Get Variable    measured
    Should Be Equal As Integers    ${count}    1

Key
    Requires                    booted
    Test Uart Is Idle           0.05
    Set Pin                     P3.2    ${False}
    Wait For Line On Uart       KEY    timeout=0.01
    Set Pin                     P3.2    ${None}
    Should Not Be On Uart       KEY    timeout=0.05

Reset
    Requires                    booted
    Execute Command             machine Reset
    Execute Command             emulation RunFor "0.1"
    Wait For Line On Uart       READY    timeout=0.2
